#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "components/formats/xtf/time.h"

namespace ensonify::formats::xtf {

/// A sample of a motion sensor.
struct Attitude {
  static constexpr std::uint8_t kType = 3;
  std::array<std::uint32_t, 2> spare{};
  std::uint32_t epoch_us = 0;      // the second's fraction of the source's time
  std::uint32_t source_epoch = 0;  // seconds since 1970
  float pitch_deg = 0;             // nose up
  float roll_deg = 0;              // to starboard: port up
  float heave_m = 0;               // up
  float yaw_deg = 0;
  std::uint32_t time_ms = 0;  // the clock of PingHeader::attitude_time_ms
  float heading_deg = 0;
  Time time;
  std::uint16_t milliseconds = 0;
  std::uint8_t spare_2 = 0;

  std::optional<std::int64_t> unix_ns() const { return time.unix_ns(milliseconds * std::int64_t{1'000'000}); }

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.spare, self.epoch_us, self.source_epoch, self.pitch_deg, self.roll_deg, self.heave_m, self.yaw_deg,
         self.time_ms, self.heading_deg, self.time, self.milliseconds, self.spare_2);
  }
  bool operator==(const Attitude&) const = default;
};

/// A fix and attitude as they came in.
struct RawNavigation {
  static constexpr std::uint8_t kType = 107;
  Time time;
  std::uint16_t tenths_ms = 0;  // called microseconds
  double y = 0;                 // latitude or northing
  double x = 0;
  double altitude_m = 0;
  float pitch_deg = 0;
  float roll_deg = 0;
  float heave_m = 0;  // up
  float heading_deg = 0;
  std::uint8_t spare = 0;

  std::optional<std::int64_t> unix_ns() const { return time.unix_ns(tenths_ms * std::int64_t{100'000}); }

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.time, self.tenths_ms, self.y, self.x, self.altitude_m, self.pitch_deg, self.roll_deg, self.heave_m,
         self.heading_deg, self.spare);
  }
  bool operator==(const RawNavigation&) const = default;
};

/// A remark of the operator.
struct Notes {
  static constexpr std::uint8_t kType = 1;
  Time time;
  std::array<std::uint8_t, 35> spare{};
  std::array<char, 200> text{};

  std::optional<std::int64_t> unix_ns() const { return time.unix_ns(0); }

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.time, self.spare, self.text);
  }
  bool operator==(const Notes&) const = default;
};

/// Text that came in over a serial line.
struct RawSerial {
  static constexpr std::uint8_t kType = 6;
  Time time;
  std::uint8_t hundredths = 0;
  std::uint16_t day_of_year = 0;
  std::uint32_t time_ms = 0;
  std::string text;

  std::optional<std::int64_t> unix_ns() const { return time.unix_ns(hundredths * std::int64_t{10'000'000}); }

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.time, self.hundredths, self.day_of_year, self.time_ms);
    wire.count(kU16, self.text);
    wire.each(self.text);
  }
  bool operator==(const RawSerial&) const = default;
};

}  // namespace ensonify::formats::xtf
