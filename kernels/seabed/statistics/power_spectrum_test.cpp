#include "kernels/seabed/statistics/power_spectrum.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/base/random/stream.h"
#include "kernels/seabed/statistics/testing/exact_fbm.h"

using namespace ensonify::relief_statistics;
using ensonify::random::Stream;

namespace {

constexpr double kPi = std::numbers::pi;

/// Integral of W over the plane, ring by ring.
double variance_of(const RadialSpectrum& spectrum, double window_side_m) {
  double sum = 0.0;
  for (std::size_t i = 0; i < spectrum.density_m4.size(); ++i)
    sum += spectrum.density_m4[i] * spectrum.numbers[i] * std::pow(2 * kPi / window_side_m, 2);
  return sum;
}

}  // namespace

TEST_CASE("the spectrum of white noise is level and holds its variance") {
  const Stream stream{3, "white"};
  Surface surface{256, 256, 0.25, {}};
  for (std::uint64_t i = 0; i < 65536; ++i) surface.height_m.push_back(static_cast<float>(stream.normal(i)));
  const RadialSpectrum spectrum = radial_spectrum(surface, 64);
  // W = variance * spacing^2 / (2 pi)^2. A bin's mean of N numbers in 49 overlapping windows (about 16 independent
  // ones) scatters by 1 / sqrt(16 N / 2); the smallest bins have N = 12, so 10 %, 4 sd 0.4, the largest 1 %.
  for (std::size_t i = 0; i < spectrum.density_m4.size(); ++i) {
    const double scatter = 4.0 / std::sqrt(8.0 * spectrum.numbers[i]);
    CHECK(spectrum.density_m4[i] == Approx(0.0625 / (4 * kPi * kPi)).epsilon(scatter));
  }
  // The rings to Nyquist's are pi / 4 of the square of all wave numbers.
  CHECK(variance_of(spectrum, 64 * 0.25) == Approx(kPi / 4).epsilon(0.03));
}

TEST_CASE("a plane wave's variance lands at its wave number; a tilt is nowhere") {
  Surface surface{128, 128, 1.0, {}};
  for (int row = 0; row < 128; ++row) {
    for (int column = 0; column < 128; ++column)
      surface.height_m.push_back(static_cast<float>(3.0 * column + std::sqrt(2.0) * std::cos(2 * kPi * row / 8.0)));
  }
  const RadialSpectrum spectrum = radial_spectrum(surface, 128);
  CHECK(variance_of(spectrum, 128) == Approx(1.0).epsilon(0.01));
  std::size_t highest = 0;
  for (std::size_t i = 0; i < spectrum.density_m4.size(); ++i)
    if (spectrum.density_m4[i] * spectrum.numbers[i] > spectrum.density_m4[highest] * spectrum.numbers[highest])
      highest = i;
  CHECK(spectrum.wave_number_radpm[highest] == Approx(2 * kPi / 8).epsilon(0.1));  // bins are 19 % wide
}

TEST_CASE("the exponent of exact fractional Brownian relief comes out with a small bias") {
  // The window's leakage and what folds back at Nyquist's; others measured +0.02 to +0.14 with such an estimator. Here
  // the fit stops at half Nyquist's. Mean of ten surfaces.
  for (const double hurst : {0.3, 0.625, 0.9}) {
    double exponent = 0.0;
    for (std::uint64_t s = 0; s < 10; ++s) {
      const Surface surface = exact_fbm(hurst, 256, Stream{4, "fbm"}, s);
      exponent += fit_power_law(radial_spectrum(surface, 128), 2 * kPi / 32, kPi / 2).exponent / 10;
    }
    INFO("H " << hurst << ", exponent " << exponent);
    CHECK(exponent - (2 * hurst + 2) > -0.12);
    CHECK(exponent - (2 * hurst + 2) < 0.14);
  }
}

TEST_CASE("windows with holes are left out, and none left means no spectrum") {
  Surface surface{64, 64, 1.0, std::vector<float>(4096, 1.0F)};
  surface.height_m[2080] = std::nanf("");
  CHECK(radial_spectrum(surface, 64).density_m4.empty());
  CHECK_FALSE(radial_spectrum(surface, 16).density_m4.empty());
  CHECK_THROWS_WITH(radial_spectrum(surface, 15), "window_cells is 15, allowed: even, 16 or more");
}

TEST_CASE("the difference of two spectra is that of a band's bins") {
  const RadialSpectrum quiet{{1.0, 2.0, 4.0}, {1.0, 1.0, 1.0}, {9, 9, 9}},
      loud{{1.0, 2.0, 4.0}, {10.0, 100.0, 1.0}, {9, 9, 9}};
  CHECK(difference_db(loud, quiet, 0.5, 3.0) == Approx(15.0));
  CHECK(difference_db(quiet, loud, 1.5, 5.0) == Approx(-10.0));
  CHECK_THROWS_WITH(difference_db(loud, quiet, 5.0, 6.0), "no bin of the spectra lies in the band");
  CHECK_THROWS_WITH(difference_db(loud, {}, 0.5, 3.0), "spectra to compare have other bins");
}
