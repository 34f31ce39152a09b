#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "components/formats/layout.h"

namespace ensonify::formats::all {

/// The profile in force from this time on.
struct SoundSpeedProfile {
  static constexpr std::string_view kTypes = "U";
  struct Node {
    std::uint32_t depth_steps = 0;  // of depth_step_cm
    FixedPoint<std::uint32_t, 10> sound_speed_mps;

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.depth_steps, self.sound_speed_mps);
    }
    bool operator==(const Node&) const = default;
  };
  std::uint32_t date = 0;    // when it was measured
  std::uint32_t time_s = 0;  // since midnight; seconds, unlike every other time
  std::uint16_t depth_step_cm = 1;
  std::vector<Node> nodes;

  double depth_m(const Node& node) const { return static_cast<double>(node.depth_steps) * depth_step_cm / 100; }

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.date, self.time_s);
    wire.count(kU16, self.nodes);
    wire(self.depth_step_cm);
    wire.each(self.nodes);
  }
  bool operator==(const SoundSpeedProfile&) const = default;
};

/// Sound speed at the transducer.
struct SurfaceSoundSpeed {
  static constexpr std::string_view kTypes = "G";
  struct Entry {
    std::uint16_t after_s = 0;  // after the datagram's time
    FixedPoint<std::uint16_t, 10> sound_speed_mps;

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.after_s, self.sound_speed_mps);
    }
    bool operator==(const Entry&) const = default;
  };
  std::vector<Entry> entries;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire.count(kU16, self.entries);
    wire.each(self.entries);
  }
  bool operator==(const SurfaceSoundSpeed&) const = default;
};

}  // namespace ensonify::formats::all
