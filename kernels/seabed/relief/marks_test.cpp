#include "kernels/seabed/relief/marks.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/seabed/relief/seabed.h"

using namespace ensonify::relief;
using Catch::WithinAbs;
using ensonify::frames::Vec2;

TEST_CASE("across a furrow: its depth, its berms, and the share of the spoil") {
  for (const double curvature : {0.0, 0.002, -0.002}) {
    const Mark mark{{10, 20}, Vec2(0.8, 0.6), curvature, 400.0, 1.5, 0.2, 0.5};
    const Vec2 starboard(0.6, -0.8);
    double lost = 0.0, gained = 0.0;
    for (double d = -4; d <= 4; d += 0.001) {
      const double z = height_at_m(mark, mark.middle_enu_m + d * starboard);
      (z < 0 ? lost : gained) += z * 0.001;
    }
    CHECK(height_at_m(mark, mark.middle_enu_m) == Approx(-0.2));
    CHECK(height_at_m(mark, mark.middle_enu_m + 2.25 * starboard) == Approx(0.1));
    CHECK(height_at_m(mark, mark.middle_enu_m - 2.25 * starboard) == Approx(0.1));
    CHECK(lost == Approx(-16.0 / 15.0 * 1.5 * 0.2).epsilon(1e-3));
    CHECK(gained == Approx(-0.5 * lost).epsilon(1e-3));
  }
}

TEST_CASE("a furrow is deepest on its line, turns to starboard, fades and ends") {
  const Mark mark{{0, 0}, Vec2(0, 1), 0.002, 400.0, 1.5, 0.2, 0.0};  // northward, radius 500 m
  const auto line = line_of(mark, 41);
  // After 200 m of arc: 0.4 rad.
  CHECK(line.back().x() == Approx(500 * (1 - std::cos(0.4))));
  CHECK(line.back().y() == Approx(500 * std::sin(0.4)));
  for (std::size_t i = 4; i < 37; ++i) CHECK(height_at_m(mark, line[i]) == Approx(-0.2));
  CHECK(height_at_m(mark, line[2]) == Approx(-0.1));  // half way through the first tenth
  CHECK_THAT(height_at_m(mark, line[0]), WithinAbs(0.0, 1e-9));
  CHECK(height_at_m(mark, line[40] + Vec2(0.4, 0.9)) == 0.0);
}

TEST_CASE("trawl scars come in pairs, as many as asked for, and along their heading") {
  const MarkParameters p{.tracks_per_km2 = 8.0, .length_m = 600.0, .heading_rad = 1.0, .heading_sd_rad = 0.1};
  const auto marks = Marks(p, 0.2, 4, "trawl").within({0, 0}, {10000, 10000});
  REQUIRE(marks.size() % 2 == 0);
  int inside = 0;
  double heading = 0.0;
  for (std::size_t i = 0; i < marks.size(); i += 2) {
    const Vec2 apart = marks[i + 1].middle_enu_m - marks[i].middle_enu_m,
               middle = 0.5 * (marks[i].middle_enu_m + marks[i + 1].middle_enu_m);
    CHECK(apart.norm() >= 40.0);
    CHECK(apart.norm() <= 120.0);
    CHECK_THAT(apart.dot(marks[i].ahead_enu), WithinAbs(0.0, 1e-6));
    inside += middle.x() >= 0 && middle.x() < 1e4 && middle.y() >= 0 && middle.y() < 1e4 ? 1 : 0;
    heading += std::atan2(marks[i].ahead_enu.x(), marks[i].ahead_enu.y()) / (0.5 * static_cast<double>(marks.size()));
  }
  CHECK_THAT(inside, WithinAbs(800, 4 * std::sqrt(800.0)));
  CHECK_THAT(heading, WithinAbs(1.0, 4 * 0.1 / std::sqrt(800.0)));
}

TEST_CASE("a furrow intersects a rectangle within half its width of its middle line") {
  const auto intersects_square = [](const Mark& mark) { return intersects(mark, {0, 0}, {100, 100}); };
  const auto northward = [](double east, double north) {
    return Mark{{east, north}, Vec2(0, 1), 0.0, 40.0, 2.0, 0.2, 0.5};
  };
  CHECK(intersects_square(northward(50, 50)));
  CHECK(intersects_square(northward(-1.9, 50)));  // beside it; its berm is 4 m wide
  CHECK_FALSE(intersects_square(northward(-2.1, 50)));
  CHECK(intersects_square(northward(50, -21.9)));  // its end
  CHECK_FALSE(intersects_square(northward(50, -22.1)));
  // Past the south-western corner, on a line that falls by 45 degrees.
  const auto past_corner = [](double away_m) {
    const double aside = -away_m / std::sqrt(2.0);
    return Mark{{aside, aside}, Vec2(1, -1).normalized(), 0.0, 40.0, 2.0, 0.2, 0.5};
  };
  CHECK(intersects_square(past_corner(1.8)));
  CHECK_FALSE(intersects_square(past_corner(2.2)));
  // Beside the eastern edge, arcs of radius 100 m that turn away from it: nearest is their middle, their ends are 12 m
  // off.
  const auto bulging = [](double east) { return Mark{{east, 50}, Vec2(0, 1), 0.01, 100.0, 2.0, 0.2, 0.5}; };
  CHECK(intersects_square(bulging(101.8)));
  CHECK_FALSE(intersects_square(bulging(102.2)));
}

TEST_CASE("marks are the same in every window, and cover what their closed form does") {
  const MarkParameters p{.tracks_per_km2 = 60.0, .length_m = 300.0, .heading_sd_rad = 1.0, .curvature_sd_1pm = 2e-3};
  const Marks marks(p, 0.5, 9, "trawl");
  const Window whole{0, -200, -100, 500, 400}, part{0, 33, 55, 64, 64};
  std::vector<float> all(whole.size()), some(part.size());
  marks.fill(whole, all);
  marks.fill(part, some);
  for (int j = 0; j < part.rows; ++j) {
    for (int i = 0; i < part.columns; ++i) REQUIRE(some[part.node(i, j)] == all[whole.node(i + 233, j + 155)]);
  }
  const auto list = marks.within({-100, -50}, {150, 150});
  for (int j = 0; j < whole.rows; j += 3) {
    for (int i = 0; i < whole.columns; i += 3) {
      double most = 0.0;
      for (const Mark& mark : list) {
        const double z = height_at_m(mark, {0.5 * (i - 200), 0.5 * (j - 100)});
        if (std::abs(z) > std::abs(most)) most = z;
      }
      REQUIRE_THAT(all[whole.node(i, j)], WithinAbs(most, 1e-6));
    }
  }
}

TEST_CASE("a dredged channel has a level bottom and sides of the slope asked for") {
  const Field cut = dredge_cut({{0, 0, -12}, {100, 0, -12}, {200, 0, -14}}, 10.0, 0.2, 1.0);
  const Seabed seabed([](const Window&, std::span<float> z) { std::fill(z.begin(), z.end(), -9.0F); }, nullptr,
                      {{.height_m = cut, .join = Layer::Join::kCut, .sediment = 4}});
  std::vector<float> z(41);
  std::vector<std::uint8_t> sediment(41);
  seabed.fill({0, 50, 0, 1, 41}, z, sediment);
  CHECK(z[0] == -12.0F);
  CHECK(z[10] == -12.0F);
  CHECK(z[15] == Approx(-11.0));  // 5 m up a side of 1:5
  CHECK(z[26] == -9.0F);
  CHECK(sediment[15] == 4);
  CHECK(sediment[26] == 0);
  float halfway_m = 0.0F;
  cut({0, 150, 5, 1, 1}, std::span(&halfway_m, 1));
  CHECK(halfway_m == Approx(-13.0));  // the bottom falls from place to place
}

TEST_CASE("wrong numbers are refused") {
  CHECK_THROWS_AS(Marks({.length_m = 0.0}, 0.5, 1, "x"), std::invalid_argument);
  CHECK_THROWS_AS(dredge_cut({{0, 0, -5}}, 1.0, 0.2, 1.0), std::invalid_argument);
}
