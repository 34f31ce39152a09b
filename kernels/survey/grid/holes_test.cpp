#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>

#include "kernels/base/random/stream.h"
#include "kernels/survey/grid/defects.h"

using namespace ensonify;
using namespace ensonify::survey_grid;
using Catch::WithinAbs;

namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// One letter a post: a dot is a hole.
Surface drawn(const std::vector<std::string>& rows) {
  Surface surface{static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), 1.0, {}};
  for (const auto& row : rows) {
    for (const char letter : row) surface.height_m.push_back(letter == '.' ? kNone : -20.0F);
  }
  return surface;
}

}  // namespace

TEST_CASE("holes are counted, those at the rim apart, and corners do not join them") {
  const auto holes = holes_of(drawn({
      "#######..",
      "#...####.",
      "#...#.###",
      "#...##.##",
      "#########",
  }));
  REQUIRE(holes.hole.size() == 4);
  CHECK(holes.hole[0].posts == 3);
  CHECK(holes.hole[0].at_rim);
  CHECK(holes.hole[1].posts == 9);
  CHECK_FALSE(holes.hole[1].at_rim);
  CHECK(holes.hole[1].reach_spacings == 2.0);  // from the middle of 3 x 3
  CHECK((holes.hole[1].column == 1 && holes.hole[1].row == 1));
  CHECK(holes.hole[2].posts == 1);
  CHECK(holes.hole[3].posts == 1);
  CHECK(holes.of_post[0] == -1);
  CHECK(holes.of_post[9 + 2] == 1);
}

TEST_CASE("the reach of a hole is the distance that a search of all posts finds") {
  const random::Stream noise(7, "holes_test");
  Surface surface{37, 29, 1.0, std::vector<float>(37 * 29, kNone)};
  for (std::uint64_t i = 0; i < surface.height_m.size(); ++i) {
    if (noise.uniform(i) < 0.02) surface.height_m[i] = 0.0F;
  }
  const auto holes = holes_of(surface);
  std::vector<double> reach(holes.hole.size(), 0.0);
  for (int row = 0; row < 29; ++row) {
    for (int column = 0; column < 37; ++column) {
      const auto hole = holes.of_post[static_cast<std::size_t>(row * 37 + column)];
      if (hole < 0) continue;
      double nearest = 1e9;
      for (int r = 0; r < 29; ++r) {
        for (int c = 0; c < 37; ++c) {
          if (!std::isnan(surface.at(c, r))) nearest = std::min(nearest, std::hypot(c - column, r - row));
        }
      }
      reach[static_cast<std::size_t>(hole)] = std::max(reach[static_cast<std::size_t>(hole)], nearest);
    }
  }
  for (std::size_t i = 0; i < reach.size(); ++i) CHECK_THAT(holes.hole[i].reach_spacings, WithinAbs(reach[i], 1e-6));
}

TEST_CASE("a whole surface has no hole, one without any height is refused") {
  CHECK(holes_of(drawn({"###", "###"})).hole.empty());
  CHECK_THROWS_WITH(holes_of(drawn({"..", ".."})), "the surface has no height at all; one post is needed");
}
