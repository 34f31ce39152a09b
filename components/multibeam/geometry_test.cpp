#include "components/multibeam/geometry.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace ensonify;
using frames::Attitude;
using frames::HeadPose;
using frames::Vec3;

namespace {

HeadPose pose(const Vec3& position, const Attitude& attitude) { return {position, frames::enu_from_body(attitude)}; }

}  // namespace

TEST_CASE("a level head at rest finds the seabed by plain trigonometry") {
  const HeadPose head = pose({10, 20, -1}, {});  // bow to north
  const double range = 30.0, beam = 0.7;
  const Vec3 p = sounding_enu_m(head, head, std::sin(beam), 2 * range / 1500.0, 1500.0);
  CHECK(p.x() == Approx(10 + range * std::sin(beam)));  // starboard is east
  CHECK(p.y() == Approx(20));
  CHECK(p.z() == Approx(-1 - range * std::cos(beam)));
}

TEST_CASE("a sounding is where the echo came from, however the head moves and turns meanwhile") {
  const Vec3 target(25, 3, -30);
  const HeadPose transmit = pose({0, 0, -1}, {0.10, 0.0, 0.05});
  // Pitch the transmit line so that its fan passes through the target, as the ray that met it did.
  const Vec3 to_target = frames::head_from_enu(transmit, target);
  const double pitch = std::atan2(to_target.x(), to_target.z());
  const HeadPose tilted{transmit.position_enu_m,
                        transmit.enu_from_head * frames::Quaternion(Eigen::AngleAxisd(pitch, Vec3::UnitY()))};
  REQUIRE(std::abs(frames::head_from_enu(tilted, target).x()) < 1e-9);

  const HeadPose receive = pose({0.3, 0.1, -0.9}, {0.13, 0.02, -0.04});
  const Vec3 back = target - receive.position_enu_m;
  const double sin_beam = back.normalized().dot(receive.enu_from_head * Vec3::UnitY());
  const double time = ((target - tilted.position_enu_m).norm() + back.norm()) / 1490.0;
  const Vec3 found = sounding_enu_m(tilted, receive, sin_beam, time, 1490.0);
  CHECK((found - target).norm() < 1e-5);
}
