#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "components/formats/layout.h"

namespace ensonify::formats::all {

/// Angle and travel time of every beam, as measured: "raw range and angle 78".
struct RawRangeAngle {
  static constexpr std::string_view kTypes = "N";
  struct Sector {
    FixedPoint<std::int16_t, 100> tilt_deg;  // forward, in the array's own frame
    FixedPoint<std::uint16_t, 10> focus_m;   // 0: none
    float pulse_length_s = 0;
    float delay_s = 0;  // after the datagram's time
    float centre_hz = 0;
    FixedPoint<std::uint16_t, 100> absorption_dbpkm;
    std::uint8_t waveform = 0;  // 0 CW, 1 FM up, 2 FM down
    std::uint8_t index = 0;     // EM 2040: of the transmit array; others: of the sector
    float bandwidth_hz = 0;

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.tilt_deg, self.focus_m, self.pulse_length_s, self.delay_s, self.centre_hz, self.absorption_dbpkm,
           self.waveform, self.index, self.bandwidth_hz);
    }
    bool operator==(const Sector&) const = default;
  };
  struct Beam {
    FixedPoint<std::int16_t, 100> angle_deg;  // re the receive array, to port if it is mounted forward
    std::uint8_t sector = 0;                  // ordinal of the transmit entry
    std::uint8_t detection = 0;               // bit 7: not valid; low bits: how
    std::uint16_t window_samples = 0;
    std::uint8_t quality = 0;  // 2500 * standard deviation / range
    std::int8_t doppler = 0;   // correction, in units of Dscale
    float travel_time_s = 0;   // two-way
    FixedPoint<std::int16_t, 10> reflectivity_db;
    std::int8_t cleaning = 0;
    std::uint8_t spare = 0;

    bool valid() const { return detection < 128; }

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.angle_deg, self.sector, self.detection, self.window_samples, self.quality, self.doppler,
           self.travel_time_s, self.reflectivity_db, self.cleaning, self.spare);
    }
    bool operator==(const Beam&) const = default;
  };
  FixedPoint<std::uint16_t, 10> sound_speed_mps;  // at the transducer
  std::uint16_t valid_beams = 0;
  float sampling_hz = 0;
  std::uint32_t doppler_scale = 0;
  std::vector<Sector> sectors;
  std::vector<Beam> beams;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.sound_speed_mps);
    wire.count(kU16, self.sectors);
    wire.count(kU16, self.beams);
    wire(self.valid_beams, self.sampling_hz, self.doppler_scale);
    wire.each(self.sectors);
    wire.each(self.beams);
  }
  bool operator==(const RawRangeAngle&) const = default;
};

/// Where the soundings are: "XYZ 88". z from the transmit transducer; x and y from the active antenna's place at the
/// water line, tilted with the vessel.
struct Soundings {
  static constexpr std::string_view kTypes = "X";
  struct Beam {
    float z_m = 0;  // down from the transmit transducer
    float y_m = 0;  // to starboard
    float x_m = 0;  // forward
    std::uint16_t window_samples = 0;
    std::uint8_t quality = 0;  // the byte of RawRangeAngle
    FixedPoint<std::int8_t, 10> incidence_adjustment_deg;
    std::uint8_t detection = 0;
    std::int8_t cleaning = 0;
    FixedPoint<std::int16_t, 10> reflectivity_db;

    bool valid() const { return detection < 128; }

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.z_m, self.y_m, self.x_m, self.window_samples, self.quality, self.incidence_adjustment_deg,
           self.detection, self.cleaning, self.reflectivity_db);
    }
    bool operator==(const Beam&) const = default;
  };
  FixedPoint<std::uint16_t, 100> heading_deg;
  FixedPoint<std::uint16_t, 10> sound_speed_mps;  // at the transducer
  float transducer_depth_m = 0;                   // below the water line, at the time of the ping
  std::uint16_t valid_beams = 0;
  float sampling_hz = 0;
  std::uint8_t scanning = 0;
  std::array<std::uint8_t, 3> spare{};
  std::vector<Beam> beams;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.heading_deg, self.sound_speed_mps, self.transducer_depth_m);
    wire.count(kU16, self.beams);
    wire(self.valid_beams, self.sampling_hz, self.scanning, self.spare);
    wire.each(self.beams);
  }
  bool operator==(const Soundings&) const = default;
};

}  // namespace ensonify::formats::all
