#include "tools/console/upright.h"

#include <catch2/catch.hpp>

#include "kernels/base/frames/attitude.h"

using namespace ensonify;
using console::upright;

namespace {

msg::View fan(double roll_rad) {
  msg::View view;
  view.beam_angle_rad = msg::Array<float>::of({-1.0F, 0.0F, 1.0F});
  view.find_angle_rad = msg::Array<float>::of({0.5F});
  view.enu_from_head = frames::wxyz_of(frames::enu_from_body({1.0, 0.05, roll_rad}));
  return view;
}

}  // namespace

TEST_CASE("in an upright fan each beam lies where it points in the world, seen from behind") {
  const double roll_rad = 0.2;  // starboard down: the head's axis points to port of the vertical
  const msg::View view = upright(fan(roll_rad));
  const frames::Attitude level{1.0, 0.05, 0.0};
  for (std::size_t beam = 0; beam < 3; ++beam) {
    const double before_rad = fan(roll_rad).beam_angle_rad[beam];
    const frames::Vec3 world = frames::quaternion_of(fan(roll_rad).enu_from_head) *
                               frames::Vec3(0.0, std::sin(before_rad), std::cos(before_rad));
    const frames::Vec3 seen = frames::enu_from_body(level).inverse() * world;
    CHECK_THAT(view.beam_angle_rad[beam], Catch::Matchers::WithinAbs(std::atan2(seen.y(), seen.z()), 1e-6));
  }
  CHECK(view.find_angle_rad[0] == Approx(0.3));
}

TEST_CASE("a fan stays as it is where the head looks forward, or its attitude is not known") {
  msg::View forward = fan(0.2);
  forward.beam_axis = "forward";
  CHECK(upright(forward).beam_angle_rad == forward.beam_angle_rad);
  msg::View unknown = fan(0.2);
  unknown.enu_from_head = {};
  CHECK(upright(unknown).beam_angle_rad == unknown.beam_angle_rad);
}
