#pragma once

#include <cstdint>
#include <optional>

#include "components/formats/layout.h"
#include "components/formats/utc.h"

namespace ensonify::formats::xtf {

/// Date and time of day, UTC, to the second; packets add their own fraction.
struct Time {
  std::uint16_t year = 0;
  std::uint8_t month = 0;
  std::uint8_t day = 0;
  std::uint8_t hour = 0;
  std::uint8_t minute = 0;
  std::uint8_t second = 0;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.year, self.month, self.day, self.hour, self.minute, self.second);
  }
  bool operator==(const Time&) const = default;

  /// Nanoseconds since 1970; none where the date is none.
  std::optional<std::int64_t> unix_ns(std::int64_t fraction_ns) const {
    const std::uint32_t date = year * 10'000U + month * 100U + day;
    if (!is_date(date)) return std::nullopt;
    return formats::unix_ns(date, ((hour * 60U + minute) * 60U + second) * 1'000U) + fraction_ns;
  }

  static Time of(std::int64_t unix_ns) {
    const DayTime time = day_time(unix_ns);
    const auto part = [](std::uint32_t number) { return static_cast<std::uint8_t>(number); };
    return {static_cast<std::uint16_t>(time.date / 10'000),
            part(time.date / 100 % 100),
            part(time.date % 100),
            part(time.time_ms / 3'600'000),
            part(time.time_ms / 60'000 % 60),
            part(time.time_ms / 1'000 % 60)};
  }
};

}  // namespace ensonify::formats::xtf
