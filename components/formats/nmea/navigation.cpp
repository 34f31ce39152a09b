#include "components/formats/nmea/navigation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ensonify::nmea {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kKnot_mps = 1852.0 / 3600.0;
constexpr double kFastest_knots = 1000.0;

/// hhmmss.ss as seconds of the day.
std::optional<double> time_of_day_s(std::string_view text) {
  if (text.size() < 6) return std::nullopt;
  const auto hours = number(text.substr(0, 2), 0, 23), minutes = number(text.substr(2, 2), 0, 59);
  const auto seconds = number(text.substr(4), 0, 60.999);  // a leap second has the name 60
  if (!hours || !minutes || !seconds) return std::nullopt;
  return 3600.0 * *hours + 60.0 * *minutes + *seconds;
}

std::optional<std::chrono::sys_days> date(std::string_view day, std::string_view month, std::string_view year) {
  const auto d = number(day, 1, 31), m = number(month, 1, 12), y = number(year, 0, 9999);
  if (!d || !m || !y) return std::nullopt;
  const std::chrono::year_month_day found{std::chrono::year(static_cast<int>(*y)),
                                          std::chrono::month(static_cast<unsigned>(*m)),
                                          std::chrono::day(static_cast<unsigned>(*d))};
  return found.ok() ? std::optional(std::chrono::sys_days(found)) : std::nullopt;
}

/// dddmm.mmm and its half of the globe, as degrees.
std::optional<double> angle_deg(std::string_view text, std::string_view half, char plus, char minus, double most_deg) {
  const auto packed = number(text, 0, 100.0 * most_deg);
  if (!packed || half.size() != 1 || (half[0] != plus && half[0] != minus)) return std::nullopt;
  const double degrees = std::floor(*packed / 100.0), minutes = *packed - 100.0 * degrees;
  if (minutes >= 60.0) return std::nullopt;
  return (half[0] == plus ? 1.0 : -1.0) * (degrees + minutes / 60.0);
}

/// A number where one is given. `good` becomes false for a field that is neither blank nor a number of that range.
std::optional<double> given(std::string_view text, double least, double most, bool& good) {
  if (text.empty()) return std::nullopt;
  const auto found = number(text, least, most);
  good = good && found;
  return found;
}

Navigation read_gga(const Fields& f) {
  const auto quality = number(f[6], 0, 9);
  if (!quality) return Malformed{};
  if (*quality == 0.0) return Fix{};
  const auto time_s = time_of_day_s(f[1]);
  const auto latitude = angle_deg(f[2], f[3], 'N', 'S', 90), longitude = angle_deg(f[4], f[5], 'E', 'W', 180);
  if (!time_s || !latitude || !longitude) return Malformed{};
  Fix fix{*time_s, static_cast<int>(*quality), *latitude, *longitude, number(f[8], 0, 1e3).value_or(0.0), {}, {}};
  fix.height_above_geoid_m = number(f[9], -1e4, 1e5);
  if (f.size() > 11) fix.geoid_above_ellipsoid_m = number(f[11], -1e3, 1e3);
  return fix;
}

Navigation read_rmc(const Fields& f) {
  if (f[2] == "V") return MinimumFix{};
  const auto time_s = time_of_day_s(f[1]);
  const auto latitude = angle_deg(f[3], f[4], 'N', 'S', 90), longitude = angle_deg(f[5], f[6], 'E', 'W', 180);
  bool good = f[2] == "A" && time_s && latitude && longitude;
  const auto speed = given(f[7], 0, kFastest_knots, good), course_deg = given(f[8], 0, 360, good);
  MinimumFix found;
  if (!f[9].empty()) {
    const auto year = f[9].size() == 6 ? number(f[9].substr(4), 0, 99) : std::nullopt;
    if (year) {  // 80 to 99 is the last century
      found.date = date(f[9].substr(0, 2), f[9].substr(2, 2),
                        std::to_string(static_cast<int>(*year < 80 ? 2000 + *year : 1900 + *year)));
    }
    good = good && found.date;
  }
  if (!good) return Malformed{};
  found.fix = Fix{*time_s, 1, *latitude, *longitude, 0.0, {}, {}};
  if (speed)
    found.course = Course{course_deg ? std::optional(*course_deg * kDegree) : std::nullopt, *speed * kKnot_mps};
  return found;
}

Navigation read_vtg(const Fields& f) {
  if (f.size() > 9 && f[9] == "N") return Empty{};
  bool good = true;
  const auto course_deg = given(f[1], 0, 360, good), speed = given(f[5], 0, kFastest_knots, good);
  if (!good || (f[1].size() > 0 && f[2] != "T") || (speed && f[6] != "N")) return Malformed{};
  if (!speed) return Empty{};
  return Course{course_deg ? std::optional(*course_deg * kDegree) : std::nullopt, *speed * kKnot_mps};
}

Navigation read_hdt(const Fields& f) {
  if (f[1].empty()) return Empty{};
  const auto heading_deg = number(f[1], 0, 360);
  return heading_deg && f[2] == "T" ? Navigation{Heading{*heading_deg * kDegree}} : Malformed{};
}

/// Its modes: autonomous, estimated, manual, simulator, not valid.
Navigation read_ths(const Fields& f) {
  if (f[1].empty() || f[2] == "V") return Empty{};
  const auto heading_deg = number(f[1], 0, 360);
  const bool mode = f[2] == "A" || f[2] == "E" || f[2] == "M" || f[2] == "S";
  return heading_deg && mode ? Navigation{Heading{*heading_deg * kDegree}} : Malformed{};
}

Navigation read_rot(const Fields& f) {
  if (f[1].empty() || f[2] == "V") return Empty{};
  const auto degrees_a_minute = number(f[1], -1e4, 1e4);
  return degrees_a_minute && f[2] == "A" ? Navigation{TurnRate{*degrees_a_minute * kDegree / 60.0}} : Malformed{};
}

Navigation read_zda(const Fields& f) {
  if (f[1].empty() || f[2].empty() || f[3].empty() || f[4].empty()) return Empty{};
  const auto time_s = time_of_day_s(f[1]);
  const auto day = f[4].size() == 4 ? date(f[2], f[3], f[4]) : std::nullopt;
  return time_s && day ? Navigation{DateAndTime{*time_s, *day}} : Malformed{};
}

Navigation read_gst(const Fields& f) {
  if (f[1].empty() || f[6].empty() || f[7].empty()) return Empty{};
  const auto time_s = time_of_day_s(f[1]);
  bool good = time_s.has_value();
  const auto latitude_m = given(f[6], 0, 1e6, good), longitude_m = given(f[7], 0, 1e6, good);
  const auto height_m = given(f[8], 0, 1e6, good);
  return good ? Navigation{FixAccuracy{*time_s, *latitude_m, *longitude_m, height_m}} : Malformed{};
}

Navigation read_dpt(const Fields& f) {
  if (f[1].empty()) return Empty{};
  bool good = true;
  const auto depth_m = given(f[1], 0, 12e3, good), offset_m = given(f[2], -100, 100, good);
  return good ? Navigation{WaterDepth{*depth_m, offset_m}} : Malformed{};
}

Navigation read_dbt(const Fields& f) {
  if (f[3].empty()) return Empty{};
  const auto depth_m = number(f[3], 0, 12e3);
  return depth_m && f[4] == "M" ? Navigation{WaterDepth{*depth_m, {}}} : Malformed{};
}

Navigation read_vbw(const Fields& f) {
  bool good = true;
  const auto speeds = [&](std::size_t at, std::size_t status, std::optional<double>& ahead,
                          std::optional<double>& side) {
    if (f[status] != "A") return;
    ahead = given(f[at], -kFastest_knots, kFastest_knots, good);
    side = given(f[at + 1], -kFastest_knots, kFastest_knots, good);
    for (auto* speed : {&ahead, &side}) {
      if (*speed) **speed *= kKnot_mps;
    }
  };
  TwoSpeeds found;
  speeds(1, 3, found.water_ahead_mps, found.water_starboard_mps);
  speeds(4, 6, found.ground_ahead_mps, found.ground_starboard_mps);
  if (!good) return Malformed{};
  if (!found.water_ahead_mps && !found.ground_ahead_mps) return Empty{};
  return found;
}

Navigation read_dtm(const Fields& f) {
  if (f[1].empty()) return Empty{};
  const bool is_code = f[1].size() <= 3 && std::all_of(f[1].begin(), f[1].end(), [](char c) {
                         return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
                       });
  return is_code ? Navigation{Datum{std::string(f[1])}} : Malformed{};
}

/// The fields of roll, pitch and heave, and that of heading. Field 0, the address: it has none.
struct Places {
  std::size_t roll, pitch, heave, heading;
};

Navigation read_motion(const Fields& f, const Places& at, std::optional<double> time_s) {
  bool good = true;
  const auto read = [&](std::size_t field, double least, double most, double unit) -> std::optional<double> {
    const auto found = field == 0 ? std::nullopt : given(f[field], least, most, good);
    return found ? std::optional(*found * unit) : std::nullopt;
  };
  Motion motion{time_s, {}, {}, {}, {}};
  motion.true_heading_rad = read(at.heading, 0, 360, kDegree);
  motion.roll_rad = read(at.roll, -180, 180, kDegree);
  motion.pitch_rad = read(at.pitch, -90, 90, kDegree);
  motion.heave_m = read(at.heave, -100, 100, 1.0);
  if (!good) return Malformed{};
  if (!motion.true_heading_rad && !motion.roll_rad && !motion.pitch_rad && !motion.heave_m) return Empty{};
  return motion;
}

Navigation read_timed_motion(const Fields& f, std::size_t time, const Places& at) {
  if (f[time].empty()) return Empty{};
  const auto time_s = time_of_day_s(f[time]);
  return time_s ? read_motion(f, at, time_s) : Navigation{Malformed{}};
}

/// Its heave counts down [Seapath200].
Navigation read_seapath_motion(const Fields& f) {
  Navigation read = read_motion(f, {2, 3, 5, 4}, std::nullopt);
  if (auto* motion = std::get_if<Motion>(&read); motion != nullptr && motion->heave_m)
    motion->heave_m = -*motion->heave_m;
  return read;
}

/// Of place, height, heading, roll and pitch. 0: normal, 1: reduced, 2: not valid.
Navigation read_quality(const Fields& f) {
  const auto heave = number(f[3], 0, 2), heading = number(f[4], 0, 2), roll_and_pitch = number(f[5], 0, 2);
  if (!heave || !roll_and_pitch || !heading) return Malformed{};
  return MotionQuality{*heave < 2, *roll_and_pitch < 2, *heading < 2};
}

/// The sentences of any talker.
struct Kind {
  std::string_view name;
  std::size_t fewest_fields;  // with the address
  Navigation (*read)(const Fields&);
};
constexpr std::array kKinds{Kind{"GGA", 10, read_gga}, Kind{"RMC", 10, read_rmc}, Kind{"VTG", 7, read_vtg},
                            Kind{"HDT", 3, read_hdt},  Kind{"THS", 3, read_ths},  Kind{"ROT", 3, read_rot},
                            Kind{"ZDA", 5, read_zda},  Kind{"GST", 9, read_gst},  Kind{"DPT", 3, read_dpt},
                            Kind{"DBT", 5, read_dbt},  Kind{"VBW", 7, read_vbw},  Kind{"DTM", 2, read_dtm}};

}  // namespace

Navigation read_navigation(std::string_view line) {
  const auto found = fields_of(line);
  if (std::holds_alternative<BadChecksum>(found)) return BadChecksum{};
  if (std::holds_alternative<Malformed>(found)) return Malformed{};
  const Fields& f = std::get<Fields>(found);
  const auto is = [&](std::string_view address, std::string_view part) {
    return f[0] == address && f.size() > 1 && f[1] == part;
  };
  if (f[0] == "PASHR") return f.size() < 7 ? Navigation{Malformed{}} : read_timed_motion(f, 1, {4, 5, 6, 2});
  if (is("PSAT", "HPR")) return f.size() < 6 ? Navigation{Malformed{}} : read_timed_motion(f, 2, {5, 4, 0, 3});
  if (is("PSXN", "23")) return f.size() < 6 ? Navigation{Malformed{}} : read_seapath_motion(f);
  if (is("PSXN", "20")) return f.size() < 6 ? Navigation{Malformed{}} : read_quality(f);
  for (const Kind& kind : kKinds) {
    if (is_kind(f, kind.name)) return f.size() < kind.fewest_fields ? Navigation{Malformed{}} : kind.read(f);
  }
  return Other{};
}

}  // namespace ensonify::nmea
