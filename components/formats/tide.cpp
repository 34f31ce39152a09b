#include "components/formats/tide.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>

#include "components/errors/exit_error.h"
#include "components/formats/utc.h"

namespace ensonify::formats {
namespace {

std::optional<std::pair<std::int64_t, double>> reading_of(const std::string& line) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, end = 0, found = 0;
  double second = 0.0, level_m = 0.0;
  for (const char* form : {" %4d-%2d-%2dT%2d:%2d:%lfZ %*[,;] %lf %n", " %4d/%2d/%2d %2d:%2d:%lf %lf %n"}) {
    found = std::sscanf(line.c_str(), form, &year, &month, &day, &hour, &minute, &second, &level_m, &end);
    if (found == 7) break;
  }
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  const bool time = hour >= 0 && hour < 24 && minute >= 0 && minute < 60 && second >= 0.0 && second < 61.0;
  if (found != 7 || line.find_first_not_of('\r', static_cast<std::size_t>(end)) != std::string::npos || !date.ok() ||
      !time || year < 1970 || year > 2200 || !std::isfinite(level_m))
    return std::nullopt;
  const std::int64_t days = std::chrono::sys_days(date).time_since_epoch().count();
  const std::int64_t minutes = (days * 24 + hour) * 60 + minute;
  return std::pair(minutes * 60'000'000'000 + std::llround(second * 1e9), level_m);
}

std::string utc_text(std::int64_t unix_ns) {
  const DayTime time = day_time(unix_ns);
  const auto part = [](std::uint32_t number) { return (number < 10 ? "0" : "") + std::to_string(number); };
  return std::to_string(time.date / 10'000) + "-" + part(time.date / 100 % 100) + "-" + part(time.date % 100) + "T" +
         part(time.time_ms / 3'600'000) + ":" + part(time.time_ms / 60'000 % 60) + ":" +
         part(time.time_ms / 1'000 % 60) + "Z";
}

}  // namespace

Tide::Tide(std::string file) : file_(std::move(file)) {
  std::ifstream lines(file_);
  if (!lines) throw UserError("--tide " + file_ + ": cannot be read");
  std::string line;
  bool first = true;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // a byte order mark
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#') continue;
    const auto reading = reading_of(line);
    if (reading && (readings_.empty() || reading->first > readings_.back().first)) {
      readings_.push_back(*reading);
    } else if (!first || std::isdigit(static_cast<unsigned char>(line[begin])) != 0) {
      throw UserError(file_ + ":" + std::to_string(number) +
                      ": is no reading later than those before; allowed: a UTC time and a height in m, "
                      "2025-06-01T12:00:00Z,1.35 or 2025/06/01 12:00:00 1.35");
    }
    first = false;
  }
  if (readings_.empty()) throw UserError(file_ + ": holds no reading");
}

double Tide::level_m(std::int64_t unix_ns) const {
  const auto after = std::lower_bound(readings_.begin(), readings_.end(), unix_ns,
                                      [](const auto& reading, std::int64_t t) { return reading.first < t; });
  if (after == readings_.end() || (after == readings_.begin() && after->first != unix_ns))
    throw UserError(file_ + ": has no level for " + utc_text(unix_ns) +
                    "; allowed: readings from before the survey's start to after its end");
  if (after->first == unix_ns) return after->second;
  const auto before = after - 1;
  const double part = static_cast<double>(unix_ns - before->first) / static_cast<double>(after->first - before->first);
  return before->second + part * (after->second - before->second);
}

}  // namespace ensonify::formats
