#include "kernels/seabed/relief/spectrum.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

using namespace ensonify::relief;

namespace {
constexpr double kPi = std::numbers::pi;
}

TEST_CASE("with H = 1/2 the correlation is an exponential") {
  const Spectrum spectrum{.rms_m = 0.3, .hurst = 0.5, .outer_scale_m = 40.0};
  for (const double r : {0.01, 1.0, 10.0, 200.0})
    CHECK(structure_m2(spectrum, r) == Approx(2 * 0.09 * (1 - std::exp(-2 * kPi / 40 * r))).epsilon(1e-4));
}

TEST_CASE("without inner scale the density is von Karman's, with the power law's strength") {
  const Spectrum spectrum{.rms_m = 0.3, .hurst = 0.625, .outer_scale_m = 40.0};
  const double ko = 2 * kPi / 40;
  for (const double k : {0.0, 0.1, 3.0, 100.0}) {
    const double expected = 0.09 * 0.625 * std::pow(ko, 1.25) / kPi * std::pow(k * k + ko * ko, -1.625);
    CHECK(density_m4(spectrum, k) == Approx(expected));
  }
  CHECK(density_m4(spectrum, 1000.0) == Approx(strength(spectrum) * std::pow(1000.0, -3.25)).epsilon(1e-6));
  CHECK(rms_of_strength_m(strength(spectrum), 0.625, 40.0) == Approx(0.3));
}

TEST_CASE("at small distances D = C^2 r^2H with the structure constant of TR 9407") {
  // C^2 = 2 pi w2 Gamma(2 - H) 2^-2H / (H (1 - H) Gamma(1 + H)), medium sand: w2 = 0.004446 cm^4, gamma = 3.25.
  const double h = 0.625, w2 = 0.004446 * std::pow(10.0, 2 * 3.25 - 8);
  const Spectrum sand{.rms_m = rms_of_strength_m(w2, h, 1000.0), .hurst = h, .outer_scale_m = 1000.0};
  const double c2 = 2 * kPi * w2 * std::tgamma(2 - h) * std::pow(2.0, -2 * h) / (h * (1 - h) * std::tgamma(1 + h));
  CHECK(structure_m2(sand, 0.1) ==
        Approx(c2 * std::pow(0.1, 2 * h)).epsilon(0.005));  // the outer scale takes (Ko r)^0.75 = 0.4 %
}

TEST_CASE("the density integrates to the variance; an inner scale cuts it exponentially") {
  const Spectrum spectrum{.rms_m = 0.3, .hurst = 0.4, .outer_scale_m = 50.0, .inner_scale_m = 2.0};
  double sum = 0.0;
  const double step = 1e-3;  // of ln K
  for (double x = std::log(1e-4); x < std::log(100.0); x += step) {
    const double k = std::exp(x);
    sum += density_m4(spectrum, k) * 2 * kPi * k * k * step;
  }
  CHECK(sum == Approx(0.09).epsilon(1e-4));
  // Far above Ki = pi the law is K^-(H + 3/2) exp(-K / Ki), the leading term of the Bessel function.
  const double ratio = density_m4(spectrum, 80.0) / density_m4(spectrum, 60.0);
  CHECK(ratio == Approx(std::exp(-20.0 / kPi) * std::pow(80.0 / 60.0, -1.9)).epsilon(0.02));
}

TEST_CASE("octaves hold the whole variance, and follow r^2H between the scales") {
  const Spectrum spectrum{.rms_m = 2.0, .hurst = 0.7, .outer_scale_m = 5000.0};
  const Octaves octaves = octaves_of(spectrum, 0.1);
  const double sum = std::accumulate(octaves.variance_m2.begin(), octaves.variance_m2.end(), octaves.below_posts_m2);
  CHECK(sum == Approx(4.0).epsilon(1e-6));  // less what finer octaves have in common between posts
  for (std::size_t level = 1; level < 8; ++level)
    CHECK(octaves.variance_m2[level] / octaves.variance_m2[level - 1] == Approx(std::pow(2.0, 1.4)).epsilon(0.002));
  // All finer octaves: a geometric series, of whose first term neighbours share exp(-1.905) = 15 %.
  const double first = octaves.variance_m2[0] * std::pow(2.0, -1.4);
  CHECK(octaves.below_posts_m2 ==
        Approx(first / (1 - std::pow(2.0, -1.4)) - std::exp(-1 / 0.525) * first).epsilon(2e-3));
}

TEST_CASE("an inner scale above the posts leaves nothing to make there") {
  const Octaves octaves = octaves_of({.rms_m = 1.0, .hurst = 0.5, .outer_scale_m = 100.0, .inner_scale_m = 20.0}, 0.1);
  CHECK(octaves.below_posts_m2 < 1e-8);
  CHECK(octaves.variance_m2[0] == 0.0);
  CHECK(octaves.variance_m2[1] == 0.0);
}

TEST_CASE("numbers out of range are refused with their range") {
  CHECK_THROWS_WITH(check({.rms_m = 1.0, .hurst = 1.2}),
                    "relief spectrum: hurst is 1.200000, allowed: more than 0, at most 1");
  CHECK_THROWS_WITH(check({.rms_m = -1.0}), "relief spectrum: rms_m is -1.000000, allowed: 0 or more");
  CHECK_THROWS_WITH(check({.outer_scale_m = 1.0, .inner_scale_m = 2.0}),
                    "relief spectrum: inner_scale_m is 2.000000, allowed: 0 or more, below outer_scale_m");
}
