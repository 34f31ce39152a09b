#include "kernels/seabed/relief/spectral_surface.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/seabed/statistics/power_spectrum.h"
#include "kernels/seabed/statistics/testing/exact_fbm.h"

using namespace ensonify::relief;
using namespace ensonify::relief_statistics;
using Catch::WithinAbs;

namespace {

constexpr double kPi = std::numbers::pi;

std::vector<float> heights(const SpectralSurface& surface, const Window& window) {
  std::vector<float> out(window.size());
  surface.fill(window, out);
  return out;
}

Surface square(const SpectralSurface& surface, int posts, double spacing_m) {
  return {posts, posts, spacing_m, heights(surface, {0, 0, 0, posts, posts})};
}

}  // namespace

TEST_CASE("the rms is the one asked for, within 2 % over 25 outer scales") {
  // Heights are independent beyond about half an outer scale: some 2500 numbers, whose rms scatters by 1.4 %; the mean
  // of four surfaces by 0.7 %.
  for (const double hurst : {0.3, 0.625, 0.9}) {
    double mean_square = 0.0;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const SpectralSurface surface({.rms_m = 0.5, .hurst = hurst, .outer_scale_m = 8.0}, 0.25, seed, "rms");
      for (const float z : square(surface, 800, 0.25).height_m) mean_square += z * z / (4 * 800.0 * 800.0);
    }
    INFO("H " << hurst);
    CHECK(std::sqrt(mean_square) == Approx(0.5).epsilon(0.02));
  }
}

TEST_CASE("the structure function is the closed form over two decades") {
  const int surfaces = 6;
  for (const double hurst : {0.3, 0.625, 0.9}) {
    const Spectrum spectrum{.rms_m = 0.5, .hurst = hurst, .outer_scale_m = 100.0};
    std::vector<Surface> drawn;
    for (std::uint64_t seed = 0; seed < surfaces; ++seed)
      drawn.push_back(square(SpectralSurface(spectrum, 0.1, seed, "D"), 512, 0.1));
    for (const int lag : {1, 2, 4, 8, 16, 32, 64, 128}) {
      double mean = 0.0;
      for (const Surface& z : drawn) mean += structure_function(z, lag, 2.0) / surfaces;
      INFO("H " << hurst << ", lag " << lag);
      // The octaves' ripple is 2 to 4 % of W and 3 % of D at H = 0.3, else less; pairs at long lags scatter: (lag /
      // 512) per surface, and where long waves carry the slopes (H towards 1) short lags do as these.
      const double ripple = hurst < 0.5 ? 0.03 : 0.02, scatter = hurst > 0.8 ? 0.06 : 0.0;
      CHECK(mean == Approx(structure_m2(spectrum, 0.1 * lag)).epsilon(ripple + scatter + 0.5 * lag / 512.0));
    }
  }
}

TEST_CASE("triangles between posts have the mean square slope of the closed form") {
  const Spectrum spectrum{.rms_m = 0.05, .hurst = 0.625, .outer_scale_m = 40.0};
  double mean = 0.0;
  const int surfaces = 4, posts = 512;
  for (std::uint64_t seed = 0; seed < surfaces; ++seed) {
    const Surface z = square(SpectralSurface(spectrum, 0.1, seed, "facets"), posts, 0.1);
    for (int row = 0; row + 1 < posts; ++row) {
      for (int column = 0; column + 1 < posts; ++column) {
        const double east = (z.at(column + 1, row) - z.at(column, row)) / 0.1;
        const double north = (z.at(column, row + 1) - z.at(column, row)) / 0.1;
        mean += (east * east + north * north) / (surfaces * 511.0 * 511.0);
      }
    }
  }
  // The octaves' ripple is 2.5 % of W at most; a million slopes, nearly independent, scatter by 0.2 %.
  CHECK(mean == Approx(facet_mean_square_slope(spectrum, 0.1)).epsilon(0.025));
  // TR 9407's structure constant of medium silt, w2 = 5.18e-4 cm^4: 2 C^2 d^-0.75 at 0.1 m, C^2 = 11.17 w2 in cm units.
  const double w2 = 5.18e-4 * std::pow(10.0, -1.5);
  const Spectrum silt{.rms_m = rms_of_strength_m(w2, 0.625, 1000.0), .hurst = 0.625, .outer_scale_m = 1000.0};
  CHECK(facet_mean_square_slope(silt, 0.1) == Approx(2 * 11.17 * 5.18e-4 * std::pow(10.0, -0.75)).epsilon(0.005));
}

TEST_CASE("the spectrum's exponent is 2 H + 2 within 0.1, less the estimator's bias") {
  for (const double hurst : {0.3, 0.625, 0.9}) {
    double exponent = 0.0, exact = 0.0;
    const int surfaces = 6;
    for (std::uint64_t seed = 0; seed < surfaces; ++seed) {
      const SpectralSurface surface({.rms_m = 1.0, .hurst = hurst, .outer_scale_m = 4000.0}, 1.0, seed, "slope");
      const auto exponent_of = [](const Surface& z) {
        return fit_power_law(radial_spectrum(z, 128), 2 * kPi / 32, 0.9 * kPi).exponent;
      };
      exponent += exponent_of(square(surface, 256, 1.0)) / surfaces;
      exact += exponent_of(exact_fbm(hurst, 256, {seed, "exact"}, 0)) / surfaces;
    }
    INFO("H " << hurst << ", exponent " << exponent << ", of exact surfaces " << exact);
    CHECK_THAT(exponent - exact, WithinAbs(0.0, 0.1));
  }
}

TEST_CASE("a height is the same in every window that holds it") {
  const SpectralSurface surface({.rms_m = 0.5, .hurst = 0.5, .outer_scale_m = 60.0}, 0.1, 9, "window");
  for (const int level : {0, 2}) {
    const Window whole{level, -70, -33, 200, 150}, part{level, 5, 17, 33, 21};
    const auto all = heights(surface, whole), some = heights(surface, part);
    for (int j = 0; j < part.rows; ++j) {
      for (int i = 0; i < part.columns; ++i) REQUIRE(some[part.node(i, j)] == all[whole.node(i + 75, j + 50)]);
    }
  }
}

TEST_CASE("a coarser level shows the same surface without what it cannot hold") {
  const SpectralSurface surface({.rms_m = 1.0, .hurst = 0.8, .outer_scale_m = 400.0}, 1.0, 2, "level");
  const Window posts{0, 0, 0, 257, 257}, coarse{3, 0, 0, 33, 33};
  const auto fine = heights(surface, posts), blurred = heights(surface, coarse);
  double difference = 0.0, expected = surface.octaves().below_posts_m2;
  for (std::size_t level = 0; level < 3; ++level) expected += surface.octaves().variance_m2[level];
  for (int j = 0; j < 33; ++j) {
    for (int i = 0; i < 33; ++i)
      difference += std::pow(fine[posts.node(8 * i, 8 * j)] - blurred[coarse.node(i, j)], 2) / 1089;
  }
  // 1089 nearly independent numbers: their mean square scatters by 4 %; at nodes the splines stand 3 % above their
  // mean.
  CHECK(difference == Approx(expected).epsilon(0.2));
}

TEST_CASE("variance is the same on and between lattice nodes, and in all directions") {
  // One octave alone is the worst case: noise at nodes 8 posts apart, seen at every post.
  const SpectralSurface surface({.rms_m = 1.0, .hurst = 1.0, .outer_scale_m = 60.0, .inner_scale_m = 25.0}, 1.0, 4,
                                "even");
  const int posts = 1024;
  const Surface z = square(surface, posts, 1.0);
  std::vector<double> on_phase(64, 0.0);
  double diagonal = 0.0, along = 0.0;
  for (int j = 0; j + 8 < posts; ++j) {
    for (int i = 0; i + 8 < posts; ++i) {
      on_phase[static_cast<std::size_t>(8 * (j % 8) + i % 8)] += std::pow(z.at(i, j), 2) / (127.0 * 127.0);
      diagonal += std::pow(z.at(i, j) - z.at(i + 5, j + 5), 2);
      along += std::pow(z.at(i, j) - z.at(i + 7, j), 2);
    }
  }
  const auto [least, most] = std::minmax_element(on_phase.begin(), on_phase.end());
  CHECK(*most / *least < 1.04);  // a single quintic spline gives 1.027 from node to centre; a linear one 2.25
  // 5 sqrt(2) = 7.07 against 7 posts: D goes nearly as r^2 here.
  CHECK(diagonal / along == Approx(50.0 / 49.0).epsilon(0.03));
}

TEST_CASE("an amplitude scales the noise where it is; a sharp border leaves no step") {
  const SpectralSurface surface({.rms_m = 1.0, .hurst = 0.625, .outer_scale_m = 50.0}, 0.5, 5, "amplitude");
  const Field east_only = [](const Window& window, std::span<float> out) {
    for (int j = 0; j < window.rows; ++j) {
      for (int i = 0; i < window.columns; ++i)
        out[window.node(i, j)] = ((window.east + i) << window.level) >= 256 ? 2.0F : 0.0F;
    }
  };
  const Window window{0, 0, 0, 512, 256};
  const auto plain = heights(surface, window);
  std::vector<float> out(window.size());
  surface.fill(window, out, east_only);
  double largest_step = 0.0, largest_inside = 0.0;
  for (int j = 0; j < window.rows; ++j) {
    // Below 5 m every octave has ended 30 posts from the border, the longer ones fade within their nodes.
    CHECK(std::abs(out[window.node(510, j)] - 2 * plain[window.node(510, j)]) < 0.5);
    largest_step = std::max<double>(largest_step, std::abs(out[window.node(256, j)] - out[window.node(255, j)]));
    for (int i = 400; i < 511; ++i)
      largest_inside = std::max<double>(largest_inside, std::abs(out[window.node(i + 1, j)] - out[window.node(i, j)]));
  }
  CHECK(largest_step < largest_inside);
}
