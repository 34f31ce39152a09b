#include "kernels/seabed/relief/spline.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/seabed/relief/spline_variance.h"

using namespace ensonify::relief;
using Catch::WithinAbs;
using ensonify::random::Stream;

namespace {

/// Coefficients from a function of the node.
template <class Function>
Grid grid_of(const Window& window, const Function& value) {
  Grid grid{window, {}};
  for (int j = 0; j < window.rows; ++j) {
    for (int i = 0; i < window.columns; ++i)
      grid.value.push_back(static_cast<float>(value(window.east + i, window.north + j)));
  }
  return grid;
}

}  // namespace

TEST_CASE("coefficients of a plane give the plane, at every level") {
  const Window posts{0, -5, 8, 21, 14};
  const Window coarse = coarser(knots_of(posts));
  Grid fine{knots_of(posts), {}};
  refine(grid_of(coarse,
                 [](auto x, auto y) { return 3.0 + 0.5 * static_cast<double>(x) - 0.25 * static_cast<double>(y); }),
         fine);
  std::vector<float> out(posts.size());
  evaluate(fine, posts, out);
  for (int j = 0; j < posts.rows; ++j) {
    for (int i = 0; i < posts.columns; ++i)
      CHECK_THAT(out[posts.node(i, j)], WithinAbs(3.0 + 0.25 * static_cast<double>(posts.east + i) -
                                                      0.125 * static_cast<double>(posts.north + j),
                                                  1e-5));
  }
}

TEST_CASE("refinement does not change the surface") {
  const Window coarse{1, -3, 4, 9, 7};
  const Stream noise{1, "coefficients"};
  const Grid knots = grid_of(knots_of(coarse), [&](auto x, auto y) {
    return noise.normal(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y));
  });
  std::vector<float> at_coarse(coarse.size());
  evaluate(knots, coarse, at_coarse);
  const Window posts{0, 2 * coarse.east + 2, 2 * coarse.north + 2, 9, 7};  // inside, so that the same knots suffice
  Grid fine{knots_of(posts), {}};
  Grid part = grid_of(coarser(fine.window), [&](auto x, auto y) {
    return noise.normal(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y));
  });
  refine(part, fine);
  std::vector<float> at_posts(posts.size());
  evaluate(fine, posts, at_posts);
  for (int j = 0; j < posts.rows; j += 2) {
    for (int i = 0; i < posts.columns; i += 2)
      CHECK_THAT(at_posts[posts.node(i, j)], WithinAbs(at_coarse[coarse.node(1 + i / 2, 1 + j / 2)], 1e-6));
  }
}

TEST_CASE("the bell of one coefficient is the quintic B-spline") {
  const Window posts{0, -3, 0, 7, 1};
  const Grid one = grid_of(knots_of(posts), [](auto x, auto y) { return x == 0 && y == 0 ? 1.0 : 0.0; });
  std::vector<float> out(posts.size());
  evaluate(one, posts, out);
  const double middle = 66.0 / 120.0;
  for (int i = 0; i < 7; ++i) {
    const std::vector<double> bell{0, 1, 26, 66, 26, 1, 0};
    CHECK_THAT(out[static_cast<std::size_t>(i)], WithinAbs(middle * bell[static_cast<std::size_t>(i)] / 120, 1e-7));
  }
}

TEST_CASE("variance factors tend to the squared integral of the spline's square") {
  // Integral of b^2 = the degree-11 B-spline at 0 = 655177 / 1663200.
  const double limit = std::pow(655177.0 / 1663200.0, 2);
  CHECK(variance_at_posts(20) == Approx(limit).epsilon(1e-4));
  CHECK(variance_of_coefficients(20) == Approx(limit).epsilon(0.02));  // coefficients lie close above the surface
  CHECK(variance_at_posts(0) == Approx(std::pow((66 * 66 + 2 * 26 * 26 + 2) / 14400.0, 2)));
  CHECK(variance_of_coefficients(0) == 1.0);
}

TEST_CASE("white noise has its moments and no neighbours, and is a function of the node") {
  const Stream stream{7, "white"};
  const Window window{3, -300, 90, 500, 200};
  std::vector<float> noise(window.size(), 0.0F);
  add_white(stream, 2.0F, {}, window, noise);
  double sum = 0.0, squares = 0.0, east = 0.0, north = 0.0;
  for (int j = 0; j + 1 < window.rows; ++j) {
    for (int i = 0; i + 1 < window.columns; ++i) {
      const double x = noise[window.node(i, j)] / 2.0;
      sum += x;
      squares += x * x;
      east += x * noise[window.node(i + 1, j)] / 2.0;
      north += x * noise[window.node(i, j + 1)] / 2.0;
    }
  }
  const double n = 499.0 * 199.0, sd = 1.0 / std::sqrt(n);  // of a mean and of a correlation; of a variance 1.2 times
  CHECK_THAT(sum / n, WithinAbs(0.0, 4 * sd));
  CHECK_THAT(squares / n, WithinAbs(1.0, 5 * sd));
  CHECK_THAT(east / n, WithinAbs(0.0, 4 * sd));
  CHECK_THAT(north / n, WithinAbs(0.0, 4 * sd));

  const Window part{3, -129, 95, 131, 3};  // across two edges of the generator's chunks
  std::vector<float> some(part.size(), 1.0F), amplitude(part.size(), 0.5F);
  add_white(stream, 2.0F, amplitude, part, some);
  for (int j = 0; j < part.rows; ++j) {
    for (int i = 0; i < part.columns; ++i)
      REQUIRE(some[part.node(i, j)] == 1.0F + 0.5F * noise[window.node(i + 171, j + 5)]);
  }
}
