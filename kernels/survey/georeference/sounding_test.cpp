#include "kernels/survey/georeference/sounding.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/water/refraction/eigenray.h"
#include "kernels/water/refraction/thermocline.h"

using namespace ensonify;
using namespace ensonify::georeference;
using Catch::WithinAbs;
using frames::Vec3;
using refraction::SoundSpeedProfile;

namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

/// Where an instrument puts a flat seabed at `depth_m` that it receives at `angle_rad` from the vertical to starboard,
/// with its receive array rolled by roll_rad (starboard down) and steered with face_speed_mps instead of the water's.
Vec3 received_from(const SoundSpeedProfile& truth, double angle_rad, double roll_rad, double depth_m,
                   double face_speed_mps, const SoundSpeedProfile& applied, bool trace_from_cast = false) {
  const double depression = std::numbers::pi / 2 - angle_rad;
  const double one_way_s = refraction::path_to_depth(truth, 0.0, depression, depth_m)->travel_time_s;
  // Starboard down turns the array's normal to port: sound comes from angle + roll off it. The elements' delays are
  // sine / c, which the instrument reads with its own c.
  const double sin_beam = std::sin(angle_rad + roll_rad) * face_speed_mps / truth.speed_mps(0.0);
  const double estimated = std::asin(sin_beam) - roll_rad;
  return place_sounding({{0.0, std::sin(estimated), std::cos(estimated)},
                         2.0 * one_way_s,
                         0.0,
                         trace_from_cast ? applied.speed_mps(0.0) : face_speed_mps},
                        applied);
}

}  // namespace

TEST_CASE("in uniform water a sounding is plain trigonometry") {
  const Vec3 direction = Vec3(0.1, -0.7, 0.8).normalized();
  const Vec3 place = place_sounding({direction, 0.08, 3.0, 1500.0}, SoundSpeedProfile::uniform(1500.0));
  CHECK((place - 60.0 * direction).norm() < 1e-9);
  const Vec3 below = place_sounding({{0, 0, 1}, 0.08, 3.0, 1480.0}, SoundSpeedProfile::uniform(1500.0));
  CHECK((below - Vec3(0, 0, 60)).norm() < 1e-9);  // on the vertical the face's speed does not matter
}

TEST_CASE("the cast that is true puts the seabed where it is") {
  const auto water = refraction::summer_thermocline();
  for (double degrees = 0; degrees <= 75; degrees += 5) {
    const double angle = degrees * kDeg;
    const auto truth = refraction::path_to_depth(water, 0.0, std::numbers::pi / 2 - angle, 80.0);
    const Vec3 place = received_from(water, angle, 0.0, 80.0, water.speed_mps(0.0), water);
    CHECK_THAT(place.z(), WithinAbs(80.0, 1e-3));
    CHECK_THAT(place.y(), WithinAbs(truth->horizontal_m, 1e-3));
  }
}

TEST_CASE("a wrong face speed cancels on a level flat array, whatever the water") {
  // Snell's invariant is sin(beam) / face speed, which is what the elements measured.
  const auto water = refraction::summer_thermocline();
  for (double degrees = 0; degrees <= 70; degrees += 10) {
    const Vec3 place = received_from(water, degrees * kDeg, 0.0, 80.0, water.speed_mps(0.0) + 5.0, water);
    CHECK_THAT(place.z(), WithinAbs(80.0, 5e-3));
  }
}

TEST_CASE("a wrong face speed on a rolled array, or with a cast, errs as theory predicts") {
  // The angle at the array is wrong by tan(array angle) dc / c; a trace from the same wrong speed takes tan(angle) dc /
  // c off. An angle too large by e lifts a sounding by x e.
  const double c = 1500.0, dc = 1.5, H = 30.0;  // 1 in 1000: second order is below 1 % of the error
  const auto water = SoundSpeedProfile::uniform(c);
  for (const double roll_deg : {-10.0, 0.0, 10.0}) {
    for (const double angle_deg : {20.0, 40.0, 55.0}) {
      const double angle = angle_deg * kDeg, roll = roll_deg * kDeg, x = H * std::tan(angle);
      const double at_array = std::tan(angle + roll) * dc / c, by_trace = std::tan(angle) * dc / c;
      INFO("roll " << roll_deg << ", angle " << angle_deg);
      const double from_face = received_from(water, angle, roll, H, c + dc, water).z() - H;
      const double from_cast = received_from(water, angle, roll, H, c + dc, water, true).z() - H;
      CHECK(from_face == Approx(-x * (at_array - by_trace)).epsilon(0.05).margin(1e-6));
      CHECK(from_cast == Approx(-x * at_array).epsilon(0.05));
    }
  }
}

TEST_CASE("cones of a Mills cross intersect where both sines say") {
  const Vec3 x = Vec3(1.0, 0.05, 0.1).normalized(), y = Vec3(-0.1, 1.0, 0.2).normalized(), down(0, 0, 1);
  for (const double sin_receive : {-0.8, 0.0, 0.6}) {
    const Vec3 d = intersect_cones(x, 0.02, y, sin_receive, down);
    CHECK(d.norm() == Approx(1.0));
    CHECK_THAT(d.dot(x), WithinAbs(0.02, 1e-12));
    CHECK_THAT(d.dot(y), WithinAbs(sin_receive, 1e-12));
    CHECK(d.z() > 0.0);
  }
  CHECK(intersect_cones(x, 0.9, y, 0.9, down).norm() == Approx(1.0));  // they do not intersect
  CHECK_THROWS_WITH(intersect_cones(x, 0, x, 0, down), "intersect_cones: the axes must not be parallel");
}
