#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/vehicle/guidance/laws.h"

using namespace ensonify;
using namespace ensonify::guidance;
using Catch::WithinAbs;

namespace {

/// A point that makes good its course through the water at once, carried across the line.
struct Drifting {
  double cross_track_m = 0.0, integral_s = 0.0;

  void advance(const LineGains& gains, double speed_mps, double current_mps, double dt_s) {
    const double offset = course_offset_rad(gains, cross_track_m, integral_s);
    integral_s = next_integral_s(gains, cross_track_m, integral_s, dt_s);
    cross_track_m += (speed_mps * std::sin(offset) + current_mps) * dt_s;
  }
};

}  // namespace

TEST_CASE("as far off as the lookahead the course leads back at 45 degrees") {
  const LineGains gains{20.0, 0.0, 60.0};
  CHECK(course_offset_rad(gains, 20.0, 0.0) == Approx(-std::atan(1.0)));
  CHECK(course_offset_rad(gains, -20.0, 0.0) == Approx(std::atan(1.0)));
  CHECK(course_offset_rad(gains, 0.0, 0.0) == 0.0);
}

TEST_CASE("a cross current leaves lookahead v / sqrt(U^2 - v^2), with the integral nothing") {
  LineGains gains = line_gains(2.0, 0.2, 20.0);
  Drifting with, without;
  LineGains none = gains;
  none.integral_mps = 0.0;
  for (int i = 0; i < 40000; ++i) {  // 2000 s, slowest root U / (2 lookahead) (1 - sqrt(1 - 1 / damping^2)) = 1 / 150 s
    with.advance(gains, 2.0, 0.5, 0.05);
    without.advance(none, 2.0, 0.5, 0.05);
  }
  CHECK(without.cross_track_m == Approx(20.0 * 0.5 / std::sqrt(4.0 - 0.25)).epsilon(1e-6));
  CHECK(std::abs(with.cross_track_m) < 1e-4);
  CHECK(gains.integral_mps * with.integral_s == Approx(20.0 * 0.5 / std::sqrt(4.0 - 0.25)).epsilon(1e-4));
}

TEST_CASE("near the line with damping 1 the distance decays as (1 + w t) exp(-w t)") {
  const double speed_mps = 2.0, lookahead_m = 20.0;
  const LineGains gains = line_gains(speed_mps, 0.0, lookahead_m, 1.0);
  CHECK(gains.integral_mps == Approx(0.5));
  // e' = -w' (e + sigma y), y' = e / L from e = e0, y = 0: e = e0 (1 - w t) exp(-w t) with w = U / (2 L).
  Drifting vehicle{0.1, 0.0};
  const double w = speed_mps / (2.0 * lookahead_m), dt_s = 1e-3;
  for (int i = 0; i < 20000; ++i) vehicle.advance(gains, speed_mps, 0.0, dt_s);
  // Tolerance: Euler's steps are off by w dt = 5e-5 of a factor, the cubic of atan by (0.1 / 20)^2 / 3 = 8e-6.
  CHECK_THAT(vehicle.cross_track_m, WithinAbs(0.1 * (1.0 - w * 20.0) * std::exp(-w * 20.0), 2e-5));
}

TEST_CASE("lookahead grows with speed and lag; the integral stops where it would wind up") {
  CHECK(line_gains(2.0, 0.2, 15.0).lookahead_m == 15.0);
  CHECK(line_gains(10.0, 0.2, 15.0).lookahead_m == Approx(20.0));
  const LineGains gains = line_gains(2.0, 0.2, 20.0);
  double integral_s = 0.0;
  for (int i = 0; i < 100000; ++i) integral_s = next_integral_s(gains, 5.0, integral_s, 1.0);
  CHECK(integral_s == gains.most_integral_s);
}
