#pragma once

#include <cstdint>

/// Times of files, all of them UTC, and nanoseconds since 1970 (without leap seconds, as everywhere in computing).
namespace ensonify::formats {

inline constexpr std::uint32_t kDayMs = 86'400'000;

/// Whether `date` is year * 10000 + month * 100 + day of a day from 1970 to 2105.
bool is_date(std::uint32_t date);

/// Nanoseconds since 1970; `date` as above.
std::int64_t unix_ns(std::uint32_t date, std::uint32_t time_ms);

/// A date and the time of day.
struct DayTime {
  std::uint32_t date = 0;
  std::uint32_t time_ms = 0;
};
/// To the millisecond, rounded down.
DayTime day_time(std::int64_t unix_ns);

}  // namespace ensonify::formats
