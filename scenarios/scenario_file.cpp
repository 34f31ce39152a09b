#include "scenarios/scenario_file.h"

#include <cmath>
#include <cstdio>

#include "components/config/read_parameters.h"

namespace ensonify {

namespace {

struct Seed {
  std::uint64_t seed = ScenarioHeader{}.seed;

  static void parameters(auto& self, auto&& visit) { visit("seed", "", any(), "of everything random", self.seed); }
};
struct Time {
  std::string start_utc = ScenarioHeader{}.start_utc;

  static void parameters(auto& self, auto&& visit) {
    visit("start_utc", "", any(), "UTC of sim time 0, such as 2025-06-01T12:00:00Z", self.start_utc);
  }
};

}  // namespace

ParameterList header_list() {
  return {parameters_of<Seed>().front(), section_info("time", "when the run starts", parameters_of<Time>())};
}

void read_header(ConfigReader& from, ScenarioHeader& header) {
  Seed seed{header.seed};
  read_parameters(from, seed);
  header.seed = seed.seed;
  auto time = from.optional_section("time");
  if (!time) return;
  Time start{header.start_utc};
  read_parameters(*time, start);
  header.start_utc = start.start_utc;
  if (const auto ns = parse_utc_ns(header.start_utc)) {
    header.start_unix_ns = *ns;
  } else {
    time->problem("start_utc", "\"" + header.start_utc + "\" is not a UTC time such as 2025-06-01T12:00:00Z");
  }
}

std::optional<std::int64_t> parse_utc_ns(const std::string& text) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, used = 0;
  double second = 0.0;
  const int fields =
      std::sscanf(text.c_str(), "%4d-%2d-%2dT%2d:%2d:%lf%n", &year, &month, &day, &hour, &minute, &second, &used);
  if (fields != 6 || text.substr(static_cast<std::size_t>(used)) != "Z") {
    return std::nullopt;
  }
  static constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  if (year < 1970 || year > 2200 || month < 1 || month > 12 || day < 1 ||
      day > kDays[month - 1] + (month == 2 && leap ? 1 : 0) || hour < 0 || hour > 23 || minute < 0 || minute > 59 ||
      !(second >= 0.0 && second < 60.0)) {
    return std::nullopt;
  }
  // Days since 1970-01-01 of a Gregorian date, counting years from March so that the leap day comes last.
  const std::int64_t y = month > 2 ? year : year - 1;
  const std::int64_t day_of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  const std::int64_t days = 365 * y + y / 4 - y / 100 + y / 400 + day_of_year - 719468;
  const std::int64_t whole_s = ((days * 24 + hour) * 60 + minute) * 60;
  return whole_s * 1'000'000'000 + std::llround(second * 1e9);
}

}  // namespace ensonify
