#include "components/formats/utc.h"

#include <chrono>

namespace ensonify::formats {

using std::chrono::day;
using std::chrono::month;
using std::chrono::sys_days;
using std::chrono::year;
using std::chrono::year_month_day;

namespace {

year_month_day day_of(std::uint32_t date) {
  return {year(static_cast<int>(date / 10000)), month(date / 100 % 100), day(date % 100)};
}

}  // namespace

bool is_date(std::uint32_t date) { return date >= 19700101 && date <= 21051231 && day_of(date).ok(); }

std::int64_t unix_ns(std::uint32_t date, std::uint32_t time_ms) {
  const std::chrono::nanoseconds day_begin = sys_days(day_of(date)).time_since_epoch();
  return day_begin.count() + std::int64_t{time_ms} * 1'000'000;
}

DayTime day_time(std::int64_t unix_ns) {
  const std::chrono::sys_time<std::chrono::nanoseconds> time{std::chrono::nanoseconds(unix_ns)};
  const auto midnight = std::chrono::floor<std::chrono::days>(time);
  const year_month_day date(midnight);
  const auto since = std::chrono::floor<std::chrono::milliseconds>(time - midnight);
  return {static_cast<std::uint32_t>(static_cast<int>(date.year())) * 10000 +
              static_cast<unsigned>(date.month()) * 100 + static_cast<unsigned>(date.day()),
          static_cast<std::uint32_t>(since.count())};
}

}  // namespace ensonify::formats
