#include "kernels/seabed/relief/guide.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/base/random/stream.h"

using namespace ensonify::relief;
using Catch::WithinAbs;

namespace {

template <class Function>
Raster raster_of(Function value) {
  Raster raster{40, 30, 4.0, {-10.0, 6.0}, {}};
  for (int j = 0; j < raster.rows; ++j) {
    for (int i = 0; i < raster.columns; ++i)
      raster.value.push_back(static_cast<float>(value(-10.0 + 4.0 * i, 6.0 + 4.0 * j)));
  }
  return raster;
}

float at(const Field& field, std::int64_t east, std::int64_t north) {
  float value = 0.0F;
  field({0, east, north, 1, 1}, std::span(&value, 1));
  return value;
}

}  // namespace

TEST_CASE("the surface passes through the raster's values, at the edges too") {
  const ensonify::random::Stream noise{1, "raster"};
  const Raster raster = raster_of([&](double x, double y) {
    return -20.0 + noise.normal(static_cast<std::uint64_t>(x + 10), static_cast<std::uint64_t>(y));
  });
  const Field surface = smooth_surface(raster, 0.5);
  for (int j = 0; j < 30; ++j) {
    for (int i = 0; i < 40; ++i) {
      INFO(i << ", " << j);
      CHECK_THAT(at(surface, -20 + 8 * i, 12 + 8 * j),
                 WithinAbs(raster.value[static_cast<std::size_t>(40 * j + i)], 1e-5));
    }
  }
}

TEST_CASE("a wave of eight cells is kept within 0.1 %; beyond the edge the edge continues") {
  const auto wave = [](double x, double y) { return std::sin(2 * std::numbers::pi * (x + 10.0) / 32.0 + 0.3 * y / 4); };
  const Field surface = smooth_surface(raster_of(wave), 0.5);
  // A cubic spline's error for a wave of n cells is (2 pi / n)^4 / 720 of it or so: 5e-4 for 8.
  for (std::int64_t east = 60; east < 200; east += 7)
    CHECK_THAT(at(surface, east, 90), WithinAbs(wave(0.5 * static_cast<double>(east), 45.0), 2e-3));
  CHECK(at(surface, 1000, 90) == at(surface, 292, 90));
  CHECK(at(surface, -500, 90) == at(surface, -20, 90));
}

TEST_CASE("a node has the same bits in every window and level") {
  const ensonify::random::Stream noise{2, "raster"};
  const Field surface =
      smooth_surface(raster_of([&](double x, double y) {
                       return noise.normal(static_cast<std::uint64_t>(x + 10), static_cast<std::uint64_t>(y));
                     }),
                     0.5);
  std::vector<float> out(40 * 30), coarse(10 * 8);
  surface({0, 3, 50, 40, 30}, out);
  surface({2, 1, 13, 9, 7}, coarse);
  for (int j = 0; j < 7; ++j) {
    for (int i = 0; i < 9; ++i)
      CHECK(coarse[static_cast<std::size_t>(9 * j + i)] == out[static_cast<std::size_t>(40 * (2 + 4 * j) + 1 + 4 * i)]);
  }
  CHECK(at(surface, 3, 50) == out[0]);
}

TEST_CASE("holes and wrong sizes are refused") {
  Raster raster = raster_of([](double, double) { return 0.0; });
  raster.value[7] = std::nanf("");
  CHECK_THROWS_WITH(smooth_surface(raster, 0.5), "guide: a value is not finite; fill the holes first");
  raster.value.pop_back();
  CHECK_THROWS_AS(smooth_surface(raster, 0.5), std::invalid_argument);
}
