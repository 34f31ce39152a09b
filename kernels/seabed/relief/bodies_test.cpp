#include "kernels/seabed/relief/bodies.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/seabed/relief/mask.h"
#include "kernels/seabed/relief/seabed.h"

using namespace ensonify::relief;
using Catch::WithinAbs;
using ensonify::frames::Vec2;

namespace {

constexpr double kPi = std::numbers::pi;

int count_above(const std::vector<Body>& bodies, double radius_m, double side_m) {
  int count = 0;
  for (const Body& body : bodies) {
    const bool in = body.centre_enu_m.x() >= 0 && body.centre_enu_m.x() < side_m && body.centre_enu_m.y() >= 0 &&
                    body.centre_enu_m.y() < side_m;
    count += in && body.radius_m > radius_m ? 1 : 0;
  }
  return count;
}

}  // namespace

TEST_CASE("as many bodies as asked for, and sizes by their power law") {
  const Bodies bodies({.per_km2 = 750.0, .smallest_radius_m = 0.5, .largest_radius_m = 8.0, .size_exponent = 2.0}, 0.1,
                      5, "rocks");
  const auto found = bodies.within({0, 0}, {2000, 2000});
  // 3000 of a Poisson process: sd 55. Above twice the smallest radius a fourth of them, less what the largest cuts off.
  const double n = count_above(found, 0.0, 2000);
  CHECK_THAT(n, WithinAbs(3000, 4 * 55));
  const double cut = std::pow(0.5 / 8.0, 2.0), share = (0.25 - cut) / (1 - cut);
  CHECK_THAT(count_above(found, 1.0, 2000), WithinAbs(share * n, 4 * std::sqrt(share * n)));
  CHECK(count_above(found, 8.0, 2000) == 0);
}

TEST_CASE("volumes are those of half an ellipsoid and of the dome, round or long") {
  for (const auto& [shape, share] :
       {std::pair{BodyShape::kBoulder, 2.0 / 3.0}, {BodyShape::kMound, 1.0 / 3.0}, {BodyShape::kPockmark, 1.0 / 3.0}}) {
    const Body body{{0.3, -0.2}, 2.0, 1.5, 2.0, Vec2(0.6, 0.8)};
    double volume_m3 = 0.0;
    for (double x = -5; x < 5; x += 0.02) {
      for (double y = -5; y < 5; y += 0.02) volume_m3 += height_at_m(body, shape, {x, y}) * 0.02 * 0.02;
    }
    CHECK(volume_m3 == Approx(share * kPi * 4.0 * 1.5).epsilon(1e-3));
  }
  // The longer half axis: 2 sqrt(2) along (0.6, 0.8), the shorter sqrt(2).
  const Body body{{0, 0}, 2.0, 1.5, 2.0, Vec2(0.6, 0.8)};
  CHECK(height_at_m(body, BodyShape::kMound, 2.82 * Vec2(0.6, 0.8)) > 0.0);
  CHECK(height_at_m(body, BodyShape::kMound, 1.42 * Vec2(0.8, -0.6)) == 0.0);
}

TEST_CASE("a field of bodies is the same in every window and shows every body") {
  const BodyParameters p{
      .per_km2 = 20000.0, .smallest_radius_m = 0.3, .largest_radius_m = 1.5, .height_ln_sd = 0.3, .elongation = 2.0};
  const Bodies bodies(p, 0.1, 6, "rocks");
  const Window whole{0, -300, 200, 400, 300}, part{0, -10, 260, 50, 60};
  std::vector<float> all(whole.size()), some(part.size());
  bodies.fill(whole, all);
  bodies.fill(part, some);
  for (int j = 0; j < part.rows; ++j) {
    for (int i = 0; i < part.columns; ++i) REQUIRE(some[part.node(i, j)] == all[whole.node(i + 290, j + 60)]);
  }
  int shown = 0;
  for (const Body& body : bodies.within({-29, 21}, {9, 49})) {
    const int i = static_cast<int>(std::lround(body.centre_enu_m.x() * 10)) + 300,
              j = static_cast<int>(std::lround(body.centre_enu_m.y() * 10)) - 200;
    if (i < 0 || j < 0 || i >= 400 || j >= 300) continue;
    CHECK(all[whole.node(i, j)] > 0.5 * body.height_m);  // the middle lies 0.07 m from the node at most
    ++shown;
  }
  CHECK(shown > 10);
}

TEST_CASE("bodies stand where the mask lets them, and pockmarks go down") {
  const Field east = in_polygon({{0, -1e4}, {1e4, -1e4}, {1e4, 1e4}, {0, 1e4}}, 0.0, 0.5);
  const Bodies marks(
      {.shape = BodyShape::kPockmark, .per_km2 = 5000.0, .smallest_radius_m = 2.0, .largest_radius_m = 4.0}, 0.5, 7,
      "pock", east);
  std::vector<float> z(400 * 200);
  marks.fill({0, -200, 0, 400, 200}, z);
  double west_sum = 0.0, east_sum = 0.0;
  for (int j = 0; j < 200; ++j) {
    for (int i = 0; i < 400; ++i) {
      CHECK(z[static_cast<std::size_t>(400 * j + i)] <= 0.0F);
      (i < 192 ? west_sum : east_sum) += z[static_cast<std::size_t>(400 * j + i)];  // a pockmark reaches 4 m over
    }
  }
  CHECK(west_sum == 0.0);
  CHECK(east_sum < -100.0);
  CHECK_THROWS_AS(Bodies({.smallest_radius_m = 3.0, .largest_radius_m = 1.0}, 0.5, 7, "x"), std::invalid_argument);
}
