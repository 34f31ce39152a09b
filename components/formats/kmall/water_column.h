#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "components/formats/kmall/header.h"

namespace ensonify::formats::kmall {

/// Amplitudes, and perhaps phases, of all beams of a ping.
struct WaterColumn {
  static constexpr std::string_view kType = "#MWC";
  static constexpr std::uint8_t kVersion = 2;
  enum Phase : std::uint8_t { kNoPhase = 0, kLowResolution = 1, kHighResolution = 2 };
  struct Sector {
    float tilt_deg = 0;
    float centre_hz = 0;
    float width_along_deg = 0;
    std::uint16_t number = 0;
    std::uint16_t padding = 0;

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.tilt_deg, self.centre_hz, self.width_along_deg, self.number, self.padding);
    }
    bool operator==(const Sector&) const = default;
  };
  struct Beam {
    float angle_deg = 0;  // re vertical, to port
    std::uint16_t first_sample = 0;
    std::uint16_t detected_sample = 0;  // 0: none
    std::uint16_t sector = 0;
    float detected_sample_fine = 0;
    std::vector<std::int8_t> amplitude_half_db;
    std::vector<std::int8_t> phase_low;    // steps of 180 / 128 degrees
    std::vector<std::int16_t> phase_high;  // hundredths of a degree

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.angle_deg, self.first_sample, self.detected_sample, self.sector);
      wire.count(kU16, self.amplitude_half_db);
      wire(self.detected_sample_fine);
      wire.each(self.amplitude_half_db);
    }
    bool operator==(const Beam&) const = default;
  };
  Partition partition;
  PingPart ping;
  std::uint16_t padding = 0;
  float heave_m = 0;  // down, at transmission
  std::uint8_t phase = kNoPhase;
  std::uint8_t tvg_log_factor = 0;
  std::int8_t tvg_offset_db = 0;
  float sampling_hz = 0;
  float sound_speed_mps = 0;
  std::vector<Sector> sectors;
  std::vector<Beam> beams;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.partition, self.ping);
    wire.constant(std::uint16_t{12});
    wire.count(kU16, self.sectors);
    wire.constant(static_cast<std::uint16_t>(fixed_bytes<Sector>()));
    wire(self.padding, self.heave_m);
    wire.each(self.sectors);
    wire.constant(std::uint16_t{16});
    wire.count(kU16, self.beams);
    wire.constant(static_cast<std::uint8_t>(fixed_bytes<Beam>()));
    wire(self.phase, self.tvg_log_factor, self.tvg_offset_db, self.sampling_hz, self.sound_speed_mps);
    for (auto& beam : self.beams) {
      wire(beam);
      wire.resize(beam.phase_low, self.phase == kLowResolution ? beam.amplitude_half_db.size() : 0);
      wire.each(beam.phase_low);
      wire.resize(beam.phase_high, self.phase == kHighResolution ? beam.amplitude_half_db.size() : 0);
      wire.each(beam.phase_high);
    }
  }
  bool operator==(const WaterColumn&) const = default;
};

/// Heave of a ping whose water column stands in its own file.
struct Heave {
  static constexpr std::string_view kType = "#CHE";
  static constexpr std::uint8_t kVersion = 0;
  PingPart ping;
  float heave_m = 0;  // down

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.ping, self.heave_m);
  }
  bool operator==(const Heave&) const = default;
};

}  // namespace ensonify::formats::kmall
