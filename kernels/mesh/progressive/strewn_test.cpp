#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/mesh/progressive/objects.h"
#include "kernels/mesh/progressive/testing/meshes.h"

using namespace ensonify;
using namespace ensonify::progressive;
using Catch::WithinAbs;

namespace {

constexpr double kPi = std::numbers::pi;

Hierarchy ball() {
  const TriangleMesh mesh = bumpy_ball(40, 20);
  return hierarchy_of(mesh, collapses_of(mesh));
}

frames::Vec3 place_of(const TriangleMesh& mesh, std::size_t vertex) {
  return mesh.origin_enu_m + mesh.vertex_m[vertex].cast<double>();
}

}  // namespace

TEST_CASE("copies stand where they are said, turned clockwise, in their size") {
  const Hierarchy one = ball();
  const std::vector<Copy> copies = {{{100, 0, -20}, 0.0, 1.0}, {{140, 30, -18}, 0.5 * kPi, 0.25}};
  const Hierarchy both = copies_of(one, copies);
  CHECK(fault_of(both).empty());
  const std::size_t count = one.mesh.vertex_m.size();
  REQUIRE(both.mesh.vertex_m.size() == 2 * count);
  for (std::size_t v = 0; v < count; v += 17) {
    const frames::Vec3 own = place_of(one.mesh, v);
    CHECK((place_of(both.mesh, v) - (own + frames::Vec3(100, 0, -20))).norm() < 1e-5);
    const frames::Vec3 turned(0.25 * own.y(), -0.25 * own.x(), 0.25 * own.z());  // what was north is east
    CHECK((place_of(both.mesh, count + v) - (turned + frames::Vec3(140, 30, -18))).norm() < 1e-5);
  }
  const std::size_t splits = one.splits.size();
  for (std::size_t s = 0; s < splits; ++s) {
    REQUIRE(both.splits[s].deviation_m == one.splits[s].deviation_m);
    REQUIRE(both.splits[splits + s].deviation_m == 0.25F * one.splits[s].deviation_m);
  }
  for (const Split& split : both.splits) {
    REQUIRE(split.box_m.contains(both.mesh.vertex_m[split.removed]));
    for (const std::int32_t child : split.child) {
      if (child != kNone) REQUIRE(split.box_m.contains(both.splits[static_cast<std::size_t>(child)].box_m));
    }
  }
}

TEST_CASE("each copy is as fine as the head's view requires") {
  const Hierarchy one = ball();
  const Hierarchy both = copies_of(one, std::vector<Copy>{{{0, 0, 0}, 0.0, 1.0}, {{300, 0, 0}, 0.0, 1.0}});
  Cut cut(both);
  cut.choose(both, std::vector{fan({0, 0, 25}, 0.0, 0.0, 60.0)});  // over the first one, beyond reach of the other
  const auto of_first = std::count_if(cut.triangles().begin(), cut.triangles().end(),
                                      [&](const Triangle& corners) { return corners[0] < one.mesh.vertex_m.size(); });
  CHECK(of_first > 50);
  CHECK(static_cast<std::size_t>(of_first) == cut.triangles().size() - one.coarsest.size());
}

TEST_CASE("places fill the rectangle evenly, sizes follow their law, headings all around") {
  const Strewn strewn{.from_enu_m = {10, 0},
                      .to_enu_m = {10, 40},
                      .width_m = 6,
                      .least_scale = 0.5,
                      .most_scale = 4,
                      .size_exponent = 2};
  const random::Stream stream{1, "stones"};
  constexpr int kCount = 10'000;
  double along = 0.0, across = 0.0, large = 0.0, east = 0.0;
  for (std::uint64_t n = 0; n < kCount; ++n) {
    const Copy copy = drawn(strewn, stream, n);
    REQUIRE(std::abs(copy.position_enu_m.x() - 10) <= 3);
    REQUIRE(std::abs(copy.position_enu_m.y() - 20) <= 20);
    REQUIRE(copy.position_enu_m.z() == 0);
    REQUIRE(copy.scale >= 0.5);
    REQUIRE(copy.scale <= 4);
    along += copy.position_enu_m.y() / kCount, across += std::abs(copy.position_enu_m.x() - 10) / kCount;
    large += (copy.scale > 1 ? 1.0 : 0.0) / kCount, east += std::sin(copy.heading_rad) / kCount;
  }
  // Uniform numbers have a deviation of their range over sqrt(12); four times that of a mean of 10,000.
  CHECK_THAT(along, WithinAbs(20, 4 * 40 / std::sqrt(12.0 * kCount)));
  CHECK_THAT(across, WithinAbs(1.5, 4 * 3 / std::sqrt(12.0 * kCount)));
  CHECK_THAT(east, WithinAbs(0, 4 / std::sqrt(2.0 * kCount)));
  // N(> r) = (r^-2 - 4^-2) / (0.5^-2 - 4^-2): 0.238.
  const double share = (1 - 1.0 / 16) / (4 - 1.0 / 16);
  CHECK_THAT(large, WithinAbs(share, 4 * std::sqrt(share * (1 - share) / kCount)));
}

TEST_CASE("what cannot be strewn is refused, and none at all is a mesh of nothing") {
  CHECK_THROWS_WITH(drawn({.least_scale = 2.0, .most_scale = 1.0}, {1, "stones"}, 0),
                    "strewn: allowed are 0 < least_scale <= most_scale, size_exponent > 0, width_m >= 0");
  const Hierarchy none = copies_of(ball(), {});
  CHECK(none.mesh.triangle.empty());
  CHECK(fault_of(none).empty());
}
