#include "kernels/seabed/relief/mask.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/seabed/relief/seabed.h"

using namespace ensonify::relief;
using ensonify::frames::Vec2;

namespace {

constexpr double kSpacing = 0.5;

/// A height as a function of place, m.
template <class Function>
Field field_of(Function height) {
  return [height](const Window& window, std::span<float> out) {
    const double step = node_spacing_m(kSpacing, window.level);
    for (int j = 0; j < window.rows; ++j) {
      for (int i = 0; i < window.columns; ++i)
        out[window.node(i, j)] = static_cast<float>(
            height(static_cast<double>(window.east + i) * step, static_cast<double>(window.north + j) * step));
    }
  };
}

float at(const Field& field, std::int64_t east, std::int64_t north, int level = 0) {
  float value = 0.0F;
  field({level, east, north, 1, 1}, std::span(&value, 1));
  return value;
}

}  // namespace

TEST_CASE("a band is sharp without softness and a smooth step with it") {
  const Field depth = field_of([](double x, double) { return -x; });
  const Field sharp = in_band(depth, {.low = -20.0, .high = -10.0});
  CHECK(at(sharp, 39, 0) == 1.0F);  // -19.5
  CHECK(at(sharp, 41, 0) == 0.0F);  // -20.5
  CHECK(at(sharp, 19, 0) == 0.0F);  // -9.5
  const Field soft = in_band(depth, {.low = -20.0, .softness = 4.0});
  CHECK(at(soft, 36, 0) == 1.0F);                               // -18
  CHECK(at(soft, 40, 0) == Approx(0.5));                        // on the limit
  CHECK(at(soft, 42, 0) == Approx(3 * 0.0625 - 2 * 0.015625));  // a quarter of the way
  CHECK(at(outside(soft), 42, 0) == Approx(1 - 3 * 0.0625 + 2 * 0.015625));
  CHECK_THROWS_AS(in_band(depth, {.low = 1.0, .high = 0.0}), std::invalid_argument);
}

TEST_CASE("slope and curvature equal the closed forms, at a level and at the posts") {
  const Field plane = field_of([](double x, double y) { return 0.3 * x - 0.4 * y; });
  const Field bowl = field_of([](double x, double y) { return 0.01 * (x * x + y * y); });
  for (const int level : {0, 3}) {
    CHECK(at(slope_of(plane, kSpacing, 3), 17, -5, level) == Approx(0.5).epsilon(1e-5));
    CHECK(at(curvature_of(bowl, kSpacing, 3), 17, -5, level) == Approx(0.02).epsilon(1e-3));
  }
  // The bowl's slope, 0.02 r: 40 nodes of 0.5 m east.
  CHECK(at(slope_of(bowl, kSpacing, 2), 40, 0) == Approx(0.4).epsilon(0.01));
}

TEST_CASE("a polygon is 1 inside, 0 outside, 1/2 on its border; far windows are skipped") {
  const Field square = in_polygon({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, 2.0, kSpacing);
  CHECK(at(square, 10, 10) == 1.0F);
  CHECK(at(square, 20, 10) == Approx(0.5));
  CHECK(at(square, 21, 10) == Approx(3 * 0.0625 - 2 * 0.015625));  // half a metre out
  CHECK(at(square, 40, 10) == 0.0F);
  std::vector<float> out(16, 0.5F);
  square({0, 5, 5, 4, 4}, out);
  CHECK(out == std::vector<float>(16, 1.0F));
  // A notch: outside although within the corners' box.
  const Field notched = in_polygon({{0, 0}, {10, 0}, {5, 5}, {10, 10}, {0, 10}}, 0.0, kSpacing);
  CHECK(at(notched, 16, 10) == 0.0F);
  CHECK(at(notched, 8, 10) == 1.0F);
  CHECK_THROWS_AS(in_polygon({{0, 0}, {1, 1}}, 0.0, kSpacing), std::invalid_argument);
}

TEST_CASE("fields join node by node") {
  CHECK(at(product({constant(0.5F), constant(0.5F)}), 0, 0) == 0.25F);
  CHECK(at(largest({constant(0.2F), constant(0.7F), constant(0.1F)}), 0, 0) == 0.7F);
  CHECK(at(sum({constant(0.25F), constant(0.5F)}), 0, 0) == 0.75F);
  CHECK(at(blend(constant(0.25F), 1.0F, 3.0F), 0, 0) == 1.5F);
  CHECK(at(product({}), 0, 0) == 1.0F);
}
