#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "components/formats/xtf/ping.h"

/// Soundings as QPS writes them. Layouts by X41; no genuine file was at hand to prove them on.
namespace ensonify::formats::xtf {

/// Angle and travel time of every beam.
struct MultibeamPing {
  static constexpr std::uint8_t kType = 28;
  struct Beam {
    std::int32_t number = 0;
    double intensity = 0;
    std::int32_t quality = 0;
    double travel_time_s = 0;  // two-way
    double delay_s = 0;        // after the packet's time
    double angle_deg = 0;      // re vertical at the head, to port negative
    double tilt_deg = 0;
    std::array<float, 4> spare{};

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.number, self.intensity, self.quality, self.travel_time_s, self.delay_s, self.angle_deg, self.tilt_deg,
           self.spare);
    }
    bool operator==(const Beam&) const = default;
  };
  PingHeader header;
  std::vector<Beam> beams;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.header);
    wire.each(self.beams);
  }
  bool operator==(const MultibeamPing&) const = default;
};

/// Travel time below each of several transducers.
struct MultiTransmitPing {
  static constexpr std::uint8_t kType = 27;
  struct Beam {
    std::int32_t number = 0;
    float intensity = 0;
    std::int32_t quality = 0;
    float travel_time_s = 0;  // two-way
    float delay_s = 0;        // after the packet's time
    std::array<float, 3> offset_m{};
    std::array<float, 4> spare{};

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.number, self.intensity, self.quality, self.travel_time_s, self.delay_s, self.offset_m, self.spare);
    }
    bool operator==(const Beam&) const = default;
  };
  PingHeader header;
  std::vector<Beam> beams;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.header);
    wire.each(self.beams);
  }
  bool operator==(const MultiTransmitPing&) const = default;
};

}  // namespace ensonify::formats::xtf
