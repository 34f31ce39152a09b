#include "kernels/acoustics/echo/eigenray_echoes.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace ensonify;
using namespace ensonify::echo;
using Catch::WithinAbs;
using frames::Vec3;
using refraction::SoundSpeedProfile;

static const Carrier kCarrier{300e3, 0.07};

/// 1 m/s faster every 20 m: far more than the sea's.
static constexpr double kSurface_mps = 1480.0, kGradient_per_s = 0.05;
static double speed_mps(double depth_m) { return kSurface_mps + kGradient_per_s * depth_m; }
static SoundSpeedProfile gradient() { return SoundSpeedProfile({{0.0, speed_mps(0.0)}, {200.0, speed_mps(200.0)}}); }

/// Between two points where speed rises evenly with depth: the path is an arc of a circle.
static double arc_s(const Vec3& a, const Vec3& b) {
  const double squared = (a - b).squaredNorm() * kGradient_per_s * kGradient_per_s;
  return std::acosh(1.0 + squared / (2.0 * speed_mps(-a.z()) * speed_mps(-b.z()))) / kGradient_per_s;
}

static Scatterer patch(const Vec3& place, double one_way_s, const Vec3& head) {
  Scatterer one;
  one.position_enu_m = place;
  one.slowness_spm = float(one_way_s / (place - head).norm());
  one.scattered_upa2m2 = 1e12F;
  one.response = {0.6F, -0.8F};
  one.contributor = 7;
  return one;
}

/// Two poses a second apart: a receiver that moves, sinks and turns.
static std::vector<frames::HeadPose> moving(const Vec3& start) {
  return {{start, frames::enu_from_ned()},
          {start + Vec3(3.0, -1.0, -0.5), frames::enu_from_body({.heading_rad = 0.2, .pitch_rad = 0.05})}};
}

TEST_CASE("in water of one speed an eigenray's echo is the direct echo") {
  const Vec3 head(1.0, 2.0, -3.0);
  const auto poses = moving(head);
  Receivers receivers;
  receivers.set({0.0, 1.0, poses});
  const Scatterers patches{patch({20.0, 5.0, -40.0}, (Vec3(20, 5, -40) - head).norm() / 1500.0, head),
                           patch({1.0, 2.0, -60.0}, 57.0 / 1500.0, head)};
  Arrivals direct, exact;
  add_direct_echoes(kCarrier, head, patches, receivers, direct);
  add_eigenray_echoes(kCarrier, SoundSpeedProfile::uniform(1500.0), head, patches, receivers, exact);
  REQUIRE(exact.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    // The direct echo takes the receiver where it is after twice the time out, t = 80 ms at most: of t v / c it is then
    // v away from where it receives, which is t (v / c)^2 = 4e-7 s.
    CHECK_THAT(exact.time_s[i], WithinAbs(direct.time_s[i], 4e-7));
    CHECK_THAT(20 * std::log10(std::abs(exact.pressure_upa(i)) / std::abs(direct.pressure_upa(i))),
               WithinAbs(0.0, 1e-3));
    CHECK((exact.direction_head[i] - direct.direction_head[i]).norm() < 1e-4F);
    CHECK(exact.contributor[i] == 7);
  }
}

TEST_CASE("where speed rises evenly with depth both ways are arcs of circles, of their own lengths") {
  const Vec3 head(0.0, 0.0, -2.0);
  const auto poses = moving(head);
  Receivers receivers;
  receivers.set({0.0, 1.0, poses});
  for (const double across_m : {0.0, 10.0, 60.0, 120.0}) {
    const Vec3 place(across_m, 0.3 * across_m, -40.0);
    const double out_s = arc_s(head, place);
    Arrivals exact;
    add_eigenray_echoes(kCarrier, gradient(), head, {patch(place, out_s, head)}, receivers, exact);
    REQUIRE(exact.size() == 1);
    const double back_s = arc_s(receivers.at(exact.time_s[0]).position_enu_m, place);
    CHECK_THAT(exact.time_s[0], WithinAbs(out_s + back_s, 2e-8));  // 1e-8 s each way near the vertical
  }
}

TEST_CASE("where speed rises with depth an echo comes from below the straight line") {
  // Down and away a path turns up where speed rises: it leaves steeper than the straight line and comes back as steep.
  const Vec3 head(0.0, 0.0, -2.0), place(100.0, 0.0, -40.0);
  const frames::HeadPose pose{head, frames::enu_from_ned()};
  Receivers receivers;
  receivers.set({0.0, 1.0, std::span(&pose, 1)});
  Arrivals exact;
  add_eigenray_echoes(kCarrier, gradient(), head, {patch(place, arc_s(head, place), head)}, receivers, exact);
  const double straight = 38.0 / std::hypot(100.0, 38.0);
  // Of the circle with depth of centre c / g: the chord's angle and half of the arc's, L g cos / (2 c) to first order.
  const double turned = 0.5 * std::hypot(100.0, 38.0) * kGradient_per_s * std::cos(std::asin(straight)) / 1481.0;
  CHECK_THAT(double(exact.direction_head[0].z()), WithinAbs(std::sin(std::asin(straight) + turned), 1e-4));
  const double distance_m = std::hypot(100.0, 38.0);
  const double spherical = 1e12 * std::pow(10.0, -0.1 * 0.07 * 2.0 * distance_m) / (distance_m * distance_m);
  CHECK_THAT(10 * std::log10(std::norm(exact.pressure_upa(0)) / spherical), WithinAbs(0.0, 0.05));
}

TEST_CASE("an echo by another path than the eigenray is the direct echo") {
  const Vec3 head(0.0, 0.0, -2.0), place(60.0, 0.0, -40.0);
  const frames::HeadPose pose{head, frames::enu_from_ned()};
  Receivers receivers;
  receivers.set({0.0, 1.0, std::span(&pose, 1)});
  const Scatterers later{patch(place, 1.001 * arc_s(head, place), head)};
  Arrivals direct, exact;
  add_direct_echoes(kCarrier, head, later, receivers, direct);
  add_eigenray_echoes(kCarrier, gradient(), head, later, receivers, exact);
  CHECK(exact == direct);
}
