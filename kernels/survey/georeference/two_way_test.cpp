#include "kernels/survey/georeference/two_way.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/water/refraction/eigenray.h"

using namespace ensonify;
using frames::Attitude;
using frames::HeadPose;
using frames::Vec3;
using georeference::sounding_enu_m;
using refraction::SoundSpeedProfile;

namespace {

HeadPose pose(const Vec3& position, const Attitude& attitude) { return {position, frames::enu_from_body(attitude)}; }

}  // namespace

TEST_CASE("a level head at rest finds the seabed by plain trigonometry") {
  const HeadPose head = pose({10, 20, -1}, {});  // bow to north
  const double range = 30.0, beam = 0.7;
  const Vec3 p =
      sounding_enu_m({head, head, 0.0, std::sin(beam), 1500.0, 2 * range / 1500.0}, SoundSpeedProfile::uniform(1500.0));
  CHECK(p.x() == Approx(10 + range * std::sin(beam)));  // starboard is east
  CHECK(p.y() == Approx(20));
  CHECK(p.z() == Approx(-1 - range * std::cos(beam)));
}

TEST_CASE("a sounding is at the echo's origin, however the head moves and turns meanwhile") {
  const Vec3 target(25, 3, -30);
  const HeadPose transmit = pose({0, 0, -1}, {0.10, 0.0, 0.05});
  const Vec3 out = target - transmit.position_enu_m;
  const HeadPose receive = pose({0.3, 0.1, -0.9}, {0.13, 0.02, -0.04});
  const Vec3 back = target - receive.position_enu_m;
  const double sin_transmit = out.normalized().dot(transmit.enu_from_head * Vec3::UnitX());
  const double sin_receive = back.normalized().dot(receive.enu_from_head * Vec3::UnitY());
  const double time = (out.norm() + back.norm()) / 1490.0;
  const Vec3 found =
      sounding_enu_m({transmit, receive, sin_transmit, sin_receive, 1490.0, time}, SoundSpeedProfile::uniform(1490.0));
  CHECK((found - target).norm() < 1e-5);  // shift over range is 1e-2: its fourth power times the range is below 1e-6 m
}

TEST_CASE("in refracting water a sounding is where the ray between head and target ends") {
  const SoundSpeedProfile cast({{0.0, 1520.0}, {10.0, 1500.0}, {40.0, 1490.0}});
  const HeadPose head = pose({0, 0, -2}, {});
  const auto ray = refraction::eigenray(cast, 2.0, 45.0, 30.0);
  REQUIRE(ray);
  const Vec3 found = sounding_enu_m(
      {head, head, 0.0, std::cos(ray->launch_depression_rad), cast.speed_mps(2.0), 2.0 * ray->end.travel_time_s}, cast);
  // The eigenray ends within 1 um of the target; straight sound at the face's speed would miss it by a metre.
  CHECK((found - Vec3(45, 0, -30)).norm() < 1e-5);
}
