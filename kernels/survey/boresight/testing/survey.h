#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "kernels/base/random/stream.h"
#include "kernels/survey/boresight/adjust.h"

/// A patch test made up for tests: a boat over a calibration site, without acoustics.
namespace ensonify::boresight::testing {

using frames::Attitude;
using frames::enu_from_body;
using random::Stream;

inline constexpr double kDegree = M_PI / 180.0;

using Ground = std::function<double(double, double)>;  // height at east, north

inline double level(double, double) { return -25.0; }

/// A pad in the west with a rock 2.6 m high, and from x = 0 an incline of 5 degrees to the east.
inline double calibration_site(double x, double y) {
  const double rock = 2.6 * std::exp(-((x + 60) * (x + 60) + y * y) / (2 * 1.5 * 1.5));
  return -25.0 + rock - std::tan(5 * kDegree) * std::max(0.0, x);
}

/// The site with relief of sand upon it, drawn anew for each seed, alike for all lines: 40 waves of 20 to 0.6 m in
/// random directions, whose spectrum falls with the wavenumber's power of 3.25 as in scenarios/patch_test.
inline Ground with_relief(double sd_m, std::uint64_t seed) {
  struct Wave {
    double x, y, phase, height;
  };
  constexpr std::size_t kWaves = 40;
  const Stream stream(seed, "relief");
  std::vector<Wave> waves;
  double squares = 0.0;
  for (std::size_t n = 0; n < kWaves; ++n) {
    const double k = 2 * M_PI / 20.0 * std::pow(20.0 / 0.6, (static_cast<double>(n) + stream.uniform(0, n)) / kWaves);
    const double to = 2 * M_PI * stream.uniform(1, n), height = std::pow(k, -1.25 / 2);  // per octave: k^2 k^-3.25
    waves.push_back({k * std::cos(to), k * std::sin(to), 2 * M_PI * stream.uniform(2, n), height});
    squares += height * height / 2;
  }
  for (Wave& wave : waves) wave.height *= sd_m / std::sqrt(squares);
  return [waves](double x, double y) {
    double height = calibration_site(x, y);
    for (const Wave& w : waves) height += w.height * std::cos(w.x * x + w.y * y + w.phase);
    return height;
  };
}

/// What the sensors err by, standard deviations. All but the white ones wander with `wander_s`.
struct Errors {
  double range_m = 0.0, angle_rad = 0.0;                // white, each sounding
  double ping_level_rad = 0.0, ping_heading_rad = 0.0;  // white, each ping
  double position_m = 0.0, height_m = 0.0;
  double level_rad = 0.0, heading_rad = 0.0;
  double wander_s = 60.0;
};

/// About RTK and a fibre-optic gyro.
inline constexpr Errors kFogRtk{.range_m = 0.02,
                                .angle_rad = 0.05 * kDegree,
                                .position_m = 0.01,
                                .height_m = 0.02,
                                .level_rad = 0.008 * kDegree,
                                .heading_rad = 0.03 * kDegree};

struct Course {
  double from_x, to_x, y, speed_mps;
};

/// A Gauss-Markov wander of deviation 1 at every ping.
inline std::vector<double> wander(const Stream& stream, std::uint64_t which, std::size_t pings, double keep) {
  std::vector<double> values(pings);
  for (std::size_t n = 0; n < pings; ++n) {
    const double fresh = stream.normal(which, n);
    values[n] = n == 0 ? fresh : keep * values[n - 1] + std::sqrt(1.0 - keep * keep) * fresh;
  }
  return values;
}

/// A rolling, pitching boat on this course.
struct Boat {
  Course course;
  double heading() const { return course.to_x > course.from_x ? M_PI / 2 : -M_PI / 2; }
  double way() const { return course.to_x > course.from_x ? course.speed_mps : -course.speed_mps; }
  Vec3 at(double t) const { return {course.from_x + way() * t, course.y, 0.0}; }
  Quaternion attitude(double t, double more_heading, double more_level) const {
    return enu_from_body({.heading_rad = heading() + more_heading,
                          .pitch_rad = 1.0 * kDegree * std::sin(2 * M_PI * t / 4.7) + more_level,
                          .roll_rad = 3.0 * kDegree * std::sin(2 * M_PI * t / 6.1) - more_level});
  }
  Vec3 rate_enu(double t) const {
    const Quaternion turn = attitude(t + 0.01, 0, 0) * attitude(t - 0.01, 0, 0).conjugate();
    return turn.vec() * (2.0 / 0.02);
  }
};

/// Soundings of 32 beams over 120 degrees at 2 Hz, by an instrument that is turned and late by `truth` and knows
/// nothing of it.
inline Line survey(const Course& course, const Ground& ground, const Offsets& truth, const Errors& errors,
                   const Stream& stream) {
  const Boat boat{course};
  constexpr double kPeriod = 0.5;
  const auto pings = static_cast<std::size_t>(std::abs(course.to_x - course.from_x) / course.speed_mps / kPeriod);
  const double keep = std::exp(-kPeriod / errors.wander_s);
  std::array<std::vector<double>, 5> w;
  for (std::size_t k = 0; k < 5; ++k) w[k] = wander(stream, k, pings, keep);
  const Quaternion mounting = Eigen::AngleAxisd(truth.yaw_rad, Vec3::UnitZ()) *
                              Eigen::AngleAxisd(truth.pitch_rad, Vec3::UnitY()) *
                              Eigen::AngleAxisd(truth.roll_rad, Vec3::UnitX());
  Line line;
  line.position_sd_m = Vec3(errors.position_m, errors.position_m, errors.height_m);
  line.rotation_sd_rad = Vec3(errors.level_rad, errors.level_rad, errors.heading_rad);
  for (std::size_t n = 0; n < pings; ++n) {
    const double t = kPeriod * static_cast<double>(n);
    const Vec3 head = boat.at(t);
    const Quaternion true_head = boat.attitude(t, 0, 0) * mounting;
    const double then = t - truth.attitude_latency_s;
    const Quaternion stated =
        boat.attitude(then, errors.heading_rad * w[3][n] + errors.ping_heading_rad * stream.normal(12, n),
                      errors.level_rad * w[4][n] + errors.ping_level_rad * stream.normal(13, n));
    const Vec3 reported_at = boat.at(t - truth.position_latency_s) +
                             Vec3(errors.position_m * w[0][n], errors.position_m * w[1][n], errors.height_m * w[2][n]);
    for (std::size_t beam = 0; beam < 32; ++beam) {
      const double angle = (-60.0 + 120.0 * (static_cast<double>(beam) + 0.5) / 32) * kDegree;
      const Vec3 ray = true_head * Vec3(0, std::sin(angle), std::cos(angle));
      double range = -ground(head.x(), head.y()) / -ray.z();
      for (int i = 0; i < 20; ++i) {
        const Vec3 p = head + range * ray;
        range += (p.z() - ground(p.x(), p.y())) / -ray.z();
      }
      const double received = range + errors.range_m * stream.normal(10, n, beam);
      const double from = angle + errors.angle_rad * stream.normal(11, n, beam);
      const Vec3 away = stated * Vec3(0, received * std::sin(from), received * std::cos(from));
      line.soundings.push_back({.time_s = t,
                                .place_enu_m = reported_at + away,
                                .head_enu_m = reported_at,
                                .enu_from_body = stated,
                                .velocity_enu_mps = {boat.way(), 0, 0},
                                .rate_enu_radps = boat.rate_enu(then)});
    }
  }
  return line;
}

/// The usual lines: to and fro over pad and incline, the same at half the speed, and the rock on either side.
inline const std::vector<Course> kPatchTest = {
    {-150, 150, 0, 4}, {150, -150, 0, 4}, {-150, 150, 0, 2}, {-150, 0, 28, 4}, {-150, 0, -28, 4}};

inline std::vector<Line> survey_all(const std::vector<Course>& courses, const Ground& ground, const Offsets& truth,
                                    const Errors& errors, std::uint64_t seed) {
  std::vector<Line> lines;
  for (std::size_t n = 0; n < courses.size(); ++n) {
    lines.push_back(survey(courses[n], ground, truth, errors, Stream(seed, "line " + std::to_string(n))));
  }
  return lines;
}

inline constexpr Offsets kTruth{.position_latency_s = 0.15,
                                .attitude_latency_s = 0.012,
                                .roll_rad = 1.2 * kDegree,
                                .pitch_rad = -0.8 * kDegree,
                                .yaw_rad = 1.5 * kDegree};
/// What a patch test is asked for: 20 ms, 2 ms, 0.02, 0.1, 0.1 degrees.
inline const Unknowns kLimits = (Unknowns() << 0.020, 0.002, 0.02 * kDegree, 0.1 * kDegree, 0.1 * kDegree).finished();

/// For the sparse soundings of these tests, one per 5 m2. One laying, whose squares end at the foot of the incline:
/// across it they would bend by 6 cm, which makes position latency 10 ms too small (40 seeds, laid 3 m further east).
inline constexpr AdjustSettings kCoarse{.cell_m = 6.0, .layings = 1, .least = 4, .turn_wander_s = 60.0};

inline Unknowns error_of(const Adjusted& adjusted) { return unknowns_of(adjusted.offsets) - unknowns_of(kTruth); }

}  // namespace ensonify::boresight::testing
