#include "components/logger/moment.h"

#include <array>
#include <cmath>
#include <numbers>

#include "components/formats/nmea/writer.h"

namespace ensonify::logger {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// GGA's quality.
std::int64_t quality_of(const msg::Position& fix) {
  return fix.quality > 0 ? fix.quality : nmea::quality_of(fix.sigma_horizontal_m);
}
double hdop_of(const msg::Position& fix) { return fix.hdop > 0.0 ? fix.hdop : 1.0; }

/// As such systems make it: the dilution of precision times a length by GGA's quality.
double fix_quality_m(const msg::Position& fix) {
  constexpr std::array<double, 6> kUnit_m{10.0, 10.0, 1.0, 2.0, 0.1, 0.5};
  const auto quality = static_cast<std::size_t>(quality_of(fix));
  return hdop_of(fix) * (quality < kUnit_m.size() ? kUnit_m[quality] : kUnit_m[0]);
}

}  // namespace

Moment moment_of(const msg::Estimate& estimate, const msg::Position& fix, double heave_down_m,
                 const LoggerConfig& config, const frames::LocalProjection& world) {
  const auto& [east_m, north_m, up_m] = estimate.position_enu_m;
  const frames::Pose body{frames::Vec3(east_m, north_m, up_m), frames::quaternion_of(estimate.enu_from_body)};
  const frames::Attitude attitude = frames::attitude_of(body.enu_from_body);
  const double convergence_rad = world.convergence_rad(body.position_enu_m.head<2>());
  const auto& [east_mps, north_mps, up_mps] = estimate.velocity_enu_mps;
  const double course_rad = std::atan2(east_mps, north_mps) + convergence_rad;

  Moment moment;
  moment.stamp_ns = estimate.stamp_ns;
  moment.unix_ns = config.start_unix_ns + estimate.stamp_ns;
  moment.reference = world.geodetic_of(body.position_enu_m.head<2>());
  moment.water_line = world.geodetic_of(config.vessel.horizontal_origin_enu_m(body).head<2>());
  moment.roll_deg = attitude.roll_rad / kDegree;
  moment.pitch_deg = attitude.pitch_rad / kDegree;
  moment.heading_deg = frames::wrap_two_pi(attitude.heading_rad + convergence_rad) / kDegree;
  moment.heave_down_m = heave_down_m;
  moment.speed_mps = std::hypot(east_mps, north_mps);
  moment.course_deg = frames::wrap_two_pi(course_rad) / kDegree;
  moment.north_mps = moment.speed_mps * std::cos(course_rad);
  moment.east_mps = moment.speed_mps * std::sin(course_rad);
  moment.down_mps = -up_mps;
  moment.fix_quality_m = fix_quality_m(fix);
  moment.height_m = fix.height_above_geoid_m + fix.geoid_above_ellipsoid_m;
  return moment;
}

Moment between(const Moment& earlier, const Moment& later) {
  const auto middle = [](double a, double b) { return a + 0.5 * (b - a); };
  const auto turned = [](double a_deg, double b_deg) { return a_deg + 0.5 * std::remainder(b_deg - a_deg, 360.0); };
  const auto course_of = [&](double a_deg, double b_deg) {
    const double turned_deg = turned(a_deg, b_deg);
    return turned_deg < 0.0 ? turned_deg + 360.0 : std::fmod(turned_deg, 360.0);
  };
  const auto place = [&](const frames::Geodetic& a, const frames::Geodetic& b) {
    return frames::Geodetic{middle(a.latitude_deg, b.latitude_deg),
                            std::remainder(turned(a.longitude_deg, b.longitude_deg), 360.0)};
  };
  Moment moment = later;
  moment.stamp_ns = earlier.stamp_ns + (later.stamp_ns - earlier.stamp_ns) / 2;
  moment.unix_ns = earlier.unix_ns + (later.unix_ns - earlier.unix_ns) / 2;
  moment.reference = place(earlier.reference, later.reference);
  moment.water_line = place(earlier.water_line, later.water_line);
  moment.roll_deg = middle(earlier.roll_deg, later.roll_deg);
  moment.pitch_deg = middle(earlier.pitch_deg, later.pitch_deg);
  moment.heading_deg = course_of(earlier.heading_deg, later.heading_deg);
  moment.heave_down_m = middle(earlier.heave_down_m, later.heave_down_m);
  moment.speed_mps = middle(earlier.speed_mps, later.speed_mps);
  moment.course_deg = course_of(earlier.course_deg, later.course_deg);
  moment.north_mps = middle(earlier.north_mps, later.north_mps);
  moment.east_mps = middle(earlier.east_mps, later.east_mps);
  moment.down_mps = middle(earlier.down_mps, later.down_mps);
  return moment;
}

std::string gga_of(const Moment& moment, const msg::Position& fix, SimulatedMarks marks) {
  constexpr std::int64_t kSimulator = 8;
  constexpr std::int64_t kDay_ns = 86'400'000'000'000;
  nmea::Fix sentence;
  sentence.time_s = 1e-9 * static_cast<double>(moment.unix_ns % kDay_ns);
  sentence.quality = static_cast<int>(marks == SimulatedMarks::kDatagrams ? kSimulator : quality_of(fix));
  sentence.latitude_deg = moment.reference.latitude_deg;
  sentence.longitude_deg = moment.reference.longitude_deg;
  sentence.hdop = hdop_of(fix);
  sentence.height_above_geoid_m = fix.height_above_geoid_m;
  sentence.geoid_above_ellipsoid_m = fix.geoid_above_ellipsoid_m;
  const std::string text = nmea::gga("IN", sentence, 2);
  return text.substr(1, text.size() - 3);
}

}  // namespace ensonify::logger
