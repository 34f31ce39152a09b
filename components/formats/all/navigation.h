#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "components/formats/layout.h"

namespace ensonify::formats::all {

/// A position of one of three systems, with the sentence that it came from.
struct Position {
  static constexpr std::string_view kTypes = "P";
  FixedPoint<std::int32_t, 20'000'000> latitude_deg;
  FixedPoint<std::int32_t, 10'000'000> longitude_deg;  // half of latitude's scale
  FixedPoint<std::uint16_t, 100> fix_quality_m;
  FixedPoint<std::uint16_t, 100> speed_mps;
  FixedPoint<std::uint16_t, 100> course_deg;
  FixedPoint<std::uint16_t, 100> heading_deg;
  std::uint8_t descriptor = 0;  // low two bits: system 1 to 3; highest: it is the active one
  std::string sentence;         // without $ and line end, its checksum kept

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.latitude_deg, self.longitude_deg, self.fix_quality_m, self.speed_mps, self.course_deg, self.heading_deg,
         self.descriptor);
    wire.count(kU8, self.sentence);
    wire.each(self.sentence);
  }
  bool operator==(const Position&) const = default;
};

/// Height of the water line's origin, where a system gives one.
struct Height {
  static constexpr std::string_view kTypes = "h";
  FixedPoint<std::int32_t, 100> height_m;
  std::uint8_t kind = 0;  // 0: from GGA or GGK

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.height_m, self.kind);
  }
  bool operator==(const Height&) const = default;
};

/// About a second of attitude, corrected for the sensor's mounting.
struct Attitude {
  static constexpr std::string_view kTypes = "A";
  struct Entry {
    std::uint16_t after_ms = 0;  // after the datagram's time
    std::uint16_t status = 0;
    FixedPoint<std::int16_t, 100> roll_deg;   // port up
    FixedPoint<std::int16_t, 100> pitch_deg;  // bow up
    FixedPoint<std::int16_t, 100> heave_m;    // down
    FixedPoint<std::uint16_t, 100> heading_deg;

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.after_ms, self.status, self.roll_deg, self.pitch_deg, self.heave_m, self.heading_deg);
    }
    bool operator==(const Entry&) const = default;
  };
  std::vector<Entry> entries;
  std::uint8_t descriptor = 0;  // bits 5-4: sensor; bit 0: heading active; bits 1 to 3, 0: roll, pitch, heave active

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire.count(kU16, self.entries);
    wire.each(self.entries);
    wire(self.descriptor);
  }
  bool operator==(const Attitude&) const = default;
};

/// The same from a sensor on the network, each entry with the packet that it came in.
struct NetworkAttitude {
  static constexpr std::string_view kTypes = "n";
  struct Entry {
    std::uint16_t after_ms = 0;
    FixedPoint<std::int16_t, 100> roll_deg;
    FixedPoint<std::int16_t, 100> pitch_deg;
    FixedPoint<std::int16_t, 100> heave_m;
    FixedPoint<std::uint16_t, 100> heading_deg;
    Bytes packet;

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.after_ms, self.roll_deg, self.pitch_deg, self.heave_m, self.heading_deg);
      wire.count(kU8, self.packet);
      wire.each(self.packet);
    }
    bool operator==(const Entry&) const = default;
  };
  std::vector<Entry> entries;
  std::uint8_t descriptor = 0;
  std::uint8_t spare = 0;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire.count(kU16, self.entries);
    wire(self.descriptor, self.spare);
    wire.each(self.entries);
  }
  bool operator==(const NetworkAttitude&) const = default;
};

/// The time of an outside clock at the datagram's time.
struct Clock {
  static constexpr std::string_view kTypes = "C";
  std::uint32_t date = 0;
  std::uint32_t time_ms = 0;
  std::uint8_t pulse_per_second = 0;  // 0: none

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.date, self.time_ms, self.pulse_per_second);
  }
  bool operator==(const Clock&) const = default;
};

}  // namespace ensonify::formats::all
