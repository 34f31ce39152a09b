#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "components/formats/layout.h"

namespace ensonify::formats::all {

/// Amplitudes of whole beams; a ping takes several datagrams, each with some of the beams.
struct WaterColumn {
  static constexpr std::string_view kTypes = "k";
  struct Sector {
    FixedPoint<std::int16_t, 100> tilt_deg;
    FixedPoint<std::uint16_t, 1, 10> centre_hz;
    std::uint8_t index = 0;
    std::uint8_t spare = 0;

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.tilt_deg, self.centre_hz, self.index, self.spare);
    }
    bool operator==(const Sector&) const = default;
  };
  struct Beam {
    FixedPoint<std::int16_t, 100> angle_deg;  // re vertical, to port
    std::uint16_t first_sample = 0;
    std::uint16_t detected_sample = 0;  // 0: none
    std::uint8_t sector = 0;
    std::uint8_t number = 0;
    std::vector<std::int8_t> amplitude_half_db;

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.angle_deg, self.first_sample);
      wire.count(kU16, self.amplitude_half_db);
      wire(self.detected_sample, self.sector, self.number);
      wire.each(self.amplitude_half_db);
    }
    bool operator==(const Beam&) const = default;
  };
  std::uint16_t datagrams = 1;  // of this ping
  std::uint16_t datagram = 1;   // this one, from 1
  std::uint16_t ping_beams = 0;
  FixedPoint<std::uint16_t, 10> sound_speed_mps;
  FixedPoint<std::uint32_t, 100> sampling_hz;
  FixedPoint<std::int16_t, 100> heave_m;  // down, at transmission
  std::uint8_t tvg_log_factor = 0;        // X of X log R + 2 alpha R + offset
  std::int8_t tvg_offset_db = 0;
  std::uint8_t scanning = 0;
  std::array<std::uint8_t, 3> spare{};
  std::vector<Sector> sectors;
  std::vector<Beam> beams;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.datagrams, self.datagram);
    wire.count(kU16, self.sectors);
    wire(self.ping_beams);
    wire.count(kU16, self.beams);
    wire(self.sound_speed_mps, self.sampling_hz, self.heave_m, self.tvg_log_factor, self.tvg_offset_db, self.scanning,
         self.spare);
    wire.each(self.sectors);
    wire.each(self.beams);
  }
  bool operator==(const WaterColumn&) const = default;
};

}  // namespace ensonify::formats::all
