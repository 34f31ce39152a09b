#include "components/formats/nmea/writer.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace ensonify::nmea {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kKnot_mps = 1852.0 / 3600.0, kKilometreAnHour_mps = 1.0 / 3.6;
constexpr double kFoot_m = 0.3048, kFathom_m = 6.0 * kFoot_m;
constexpr std::int64_t kDay_ms = 86'400'000;

/// With so many decimals; what rounds to zero has no sign.
std::string number_text(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.starts_with('-') && text.find_first_of("123456789") == std::string::npos) text.erase(0, 1);
  return text;
}
std::string number_text(const std::optional<double>& value, int decimals) {
  return value ? number_text(*value, decimals) : std::string();
}

/// With its sign, plus too, as PASHR has it.
std::string signed_text(const std::optional<double>& value, int decimals) {
  if (!value) return "";
  const std::string text = number_text(*value, decimals);
  return text.starts_with('-') ? text : "+" + text;
}

/// A direction from 0 to 359.99 degrees: rounded once, so that it never reads 360.
std::string direction_text(double rad) {
  constexpr std::int64_t kTurn = 36'000;  // hundredths of a degree
  const std::int64_t steps = (std::llround(rad / kDegree * 100.0) % kTurn + kTurn) % kTurn;
  return fmt::format("{}.{:02}", steps / 100, steps % 100);
}
std::string direction_text(const std::optional<double>& rad) { return rad ? direction_text(*rad) : std::string(); }

std::optional<double> degrees(const std::optional<double>& rad) {
  return rad ? std::optional(*rad / kDegree) : std::nullopt;
}

/// hhmmss.sss: rounded once, so that seconds never read 60.
std::string time_text(double time_s, int decimals = 3) {
  const auto steps_a_second = static_cast<std::int64_t>(std::llround(std::pow(10.0, decimals)));
  const std::int64_t day = 86'400 * steps_a_second;
  const std::int64_t steps = (std::llround(time_s * static_cast<double>(steps_a_second)) % day + day) % day;
  const std::int64_t seconds = steps / steps_a_second;
  return fmt::format("{:02}{:02}{:02}.{:0{}}", seconds / 3600, seconds / 60 % 60, seconds % 60, steps % steps_a_second,
                     decimals);
}

/// Degrees and minutes with seven decimals: rounded once, so that minutes never read 60.
std::string angle_text(double angle_deg, int degree_digits, char plus, char minus) {
  constexpr std::int64_t kSteps = 10'000'000;  // of a minute
  const std::int64_t steps = std::llround(std::abs(angle_deg) * 60.0 * kSteps);
  return fmt::format("{:0{}}{:02}.{:07},{}", steps / (60 * kSteps), degree_digits, steps / kSteps % 60, steps % kSteps,
                     angle_deg < 0.0 ? minus : plus);
}

}  // namespace

std::string framed(std::string_view body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  return fmt::format("${}*{:02X}\r\n", body, sum);
}

int quality_of(double sigma_horizontal_m) {
  if (sigma_horizontal_m <= 0.1) return 4;
  return sigma_horizontal_m <= 1.5 ? 2 : 1;
}

std::string gga(std::string_view talker, const Fix& fix, int time_decimals) {
  if (fix.quality == 0) return framed(fmt::format("{}GGA,,,,,,0,00,,,M,,M,,", talker));
  return framed(fmt::format("{}GGA,{},{},{},{},12,{},{},M,{},M,,", talker, time_text(fix.time_s, time_decimals),
                            angle_text(fix.latitude_deg, 2, 'N', 'S'), angle_text(fix.longitude_deg, 3, 'E', 'W'),
                            fix.quality, fix.hdop > 0.0 ? number_text(fix.hdop, 1) : "",
                            number_text(fix.height_above_geoid_m, 3), number_text(fix.geoid_above_ellipsoid_m, 3)));
}

/// Without the ellipse of the error.
std::string gst(std::string_view talker, const FixAccuracy& accuracy) {
  return framed(fmt::format("{}GST,{},,,,,{},{},{}", talker, time_text(accuracy.time_s),
                            number_text(accuracy.latitude_m, 3), number_text(accuracy.longitude_m, 3),
                            number_text(accuracy.height_m, 3)));
}

std::string zda(std::string_view talker, const DateAndTime& time) {
  const bool next_day = std::llround(1e3 * time.time_s) >= kDay_ms;
  const std::chrono::year_month_day date(time.date + std::chrono::days(next_day ? 1 : 0));
  return framed(fmt::format("{}ZDA,{},{:02},{:02},{:04},00,00", talker, time_text(time.time_s),
                            static_cast<unsigned>(date.day()), static_cast<unsigned>(date.month()),
                            static_cast<int>(date.year())));
}

std::string vtg(std::string_view talker, const Course& course) {
  return framed(fmt::format("{}VTG,{},T,,M,{},N,{},K,A", talker, direction_text(course.true_course_rad),
                            number_text(course.speed_mps / kKnot_mps, 3),
                            number_text(course.speed_mps / kKilometreAnHour_mps, 3)));
}

std::string hdt(std::string_view talker, const Heading& heading) {
  return framed(fmt::format("{}HDT,{},T", talker, direction_text(heading.true_heading_rad)));
}

std::string rot(std::string_view talker, const TurnRate& rate) {
  return framed(fmt::format("{}ROT,{},A", talker, number_text(rate.rate_radps / kDegree * 60.0, 2)));
}

std::string dpt(std::string_view talker, const WaterDepth& depth) {
  return framed(
      fmt::format("{}DPT,{},{},", talker, number_text(depth.below_transducer_m, 2), number_text(depth.offset_m, 2)));
}

std::string dbt(std::string_view talker, const WaterDepth& depth) {
  const double depth_m = depth.below_transducer_m;
  return framed(fmt::format("{}DBT,{},f,{},M,{},F", talker, number_text(depth_m / kFoot_m, 1), number_text(depth_m, 2),
                            number_text(depth_m / kFathom_m, 1)));
}

std::string pashr(const Motion& motion, const MotionAccuracy& accuracy, int fix_quality) {
  const int satellites = fix_quality == 0 ? 0 : fix_quality == 4 ? 2 : 1;  // no fix, another, RTK with whole numbers
  return framed(fmt::format("PASHR,{},{},T,{},{},{},{},{},{},{},{}", time_text(motion.time_s.value_or(0.0)),
                            direction_text(motion.true_heading_rad), signed_text(degrees(motion.roll_rad), 2),
                            signed_text(degrees(motion.pitch_rad), 2), signed_text(motion.heave_m, 2),
                            number_text(degrees(accuracy.roll_rad), 3), number_text(degrees(accuracy.pitch_rad), 3),
                            number_text(degrees(accuracy.heading_rad), 3), satellites, motion.usable ? 1 : 0));
}

/// The first of its fields, the quality of the place, is not the motion's: 0.
std::string psxn_20(const MotionQuality& quality) {
  const auto text = [](bool good) { return good ? '0' : '2'; };
  return framed(
      fmt::format("PSXN,20,0,{},{},{}", text(quality.heave), text(quality.heading), text(quality.roll_and_pitch)));
}

/// Its heave counts down.
std::string psxn_23(const Motion& motion) {
  const auto down_m = motion.heave_m ? std::optional(-*motion.heave_m) : std::nullopt;
  return framed(fmt::format("PSXN,23,{},{},{},{}", number_text(degrees(motion.roll_rad), 2),
                            number_text(degrees(motion.pitch_rad), 2), direction_text(motion.true_heading_rad),
                            number_text(down_m, 2)));
}

}  // namespace ensonify::nmea
