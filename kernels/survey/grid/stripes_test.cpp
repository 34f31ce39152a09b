#include "kernels/survey/grid/stripes.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernels/base/random/stream.h"
#include "kernels/seabed/statistics/testing/exact_fbm.h"

using namespace ensonify;
using namespace ensonify::survey_grid;
using Catch::WithinAbs;

namespace {

constexpr int kPosts = 512;
constexpr double kAlong_rad = 32.0 * std::numbers::pi / 180.0, kSpacing = 44.0, kSd_m = 0.05;

/// Relief of 5 cm rms within some 50 cells: sqrt(r^(2 H)) = 7 at r = 50 / 2 and H = 0.6.
Surface relief() {
  auto surface = relief_statistics::exact_fbm(0.6, kPosts, random::Stream(5, "fbm"), 0);
  for (float& height_m : surface.height_m) height_m *= 0.007F;
  return surface;
}

double stripe_m(int column, int row) {
  const double across = -column * std::sin(kAlong_rad) + row * std::cos(kAlong_rad);
  return std::sqrt(2.0) * kSd_m * std::cos(2.0 * std::numbers::pi * across / kSpacing);
}

Surface striped() {
  auto surface = relief();
  for (int row = 0; row < kPosts; ++row) {
    for (int column = 0; column < kPosts; ++column)
      surface.height_m[static_cast<std::size_t>(row * kPosts + column)] += static_cast<float>(stripe_m(column, row));
  }
  return surface;
}

}  // namespace

TEST_CASE("isotropic relief and a tilted plane have no stripes") {
  CHECK_FALSE(stripes_of(relief()).found);
  Surface plane{200, 150, 1.0, {}};
  for (int i = 0; i < 200 * 150; ++i) plane.height_m.push_back(static_cast<float>(0.03 * (i % 200)));
  CHECK_FALSE(stripes_of(plane).found);
  CHECK_FALSE(stripes_of(Surface{50, 50, 1.0, std::vector<float>(2500, -9.0F)}).found);
}

TEST_CASE("stripes are found with direction, spacing and size") {
  auto surface = striped();
  for (int i = 0; i < 60 * kPosts; ++i)
    surface.height_m[static_cast<std::size_t>(i)] = std::numeric_limits<float>::quiet_NaN();
  const auto stripes = stripes_of(surface);
  REQUIRE(stripes.found);
  CHECK_THAT(stripes.along_rad, WithinAbs(kAlong_rad, 2.0 * std::numbers::pi / 180.0));  // one step of direction
  CHECK_THAT(stripes.spacing_spacings, WithinAbs(kSpacing, 2.0));
  CHECK(stripes.sd_m == Approx(kSd_m).epsilon(0.2));  // the relief's own part of that direction is not distinguished
}

TEST_CASE("removed stripes leave the relief") {
  auto surface = striped();
  const auto wanted = relief();
  const auto changed = remove_stripes(surface, stripes_of(surface));
  CHECK(changed > kPosts * kPosts / 2);
  double stripes = 0.0, left = 0.0;
  for (int row = 100; row < kPosts - 100; ++row) {
    for (int column = 100; column < kPosts - 100; ++column) {
      left += std::pow(surface.at(column, row) - wanted.at(column, row), 2);
      stripes += std::pow(stripe_m(column, row), 2);
    }
  }
  // A mean over 128 cells of relief that has forgotten itself after some 50 of them: a third of its 5 cm go as well.
  CHECK(std::sqrt(left / stripes) < 0.5);
  CHECK_FALSE(stripes_of(surface).found);
}
