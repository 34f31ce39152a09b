#include "kernels/seabed/backscatter.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "kernels/seabed/law.h"

using namespace ensonify::seabed;
using Catch::WithinAbs;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

double db(double ratio) { return 10.0 * std::log10(ratio); }

double strength_db(const SedimentParameters& sediment, double frequency_hz, double sound_speed_mps, double degrees) {
  return db(SedimentBackscatter(sediment, frequency_hz, sound_speed_mps)(degrees * kDegree));
}

/// 10, 14, 20, .. 1000 kHz.
std::vector<double> frequencies_hz() {
  std::vector<double> value;
  for (int i = 0; i <= 14; ++i) value.push_back(1e4 * std::pow(10.0, i / 7.0));
  return value;
}

}  // namespace

TEST_CASE("table 3 of the report: medium sand at 30 and 100 kHz, 1528 m/s") {
  const auto sand = sediment_of("medium sand").value();
  const double degrees[] = {10, 20, 40, 60, 80, 90};
  const double at_30_khz[] = {-35.4, -28.3, -23.5, -21.2, -10.8, -3.1};
  const double at_100_khz[] = {-29.8, -24.2, -21.7, -19.5, -12.2, -9.7};
  for (int i = 0; i < 6; ++i) {
    INFO(degrees[i] << " degrees");
    CHECK_THAT(strength_db(sand, 30e3, 1528, degrees[i]), WithinAbs(at_30_khz[i], 0.1));
    CHECK_THAT(strength_db(sand, 100e3, 1528, degrees[i]), WithinAbs(at_100_khz[i], 0.1));
  }
}

TEST_CASE("an independent implementation's values at 100 kHz, 1500 m/s") {
  const double degrees[] = {10, 30, 45, 60, 90};
  const auto check = [&](const SedimentParameters& sediment, std::vector<double> expected_db) {
    for (int i = 0; i < 5; ++i) {
      INFO(degrees[i] << " degrees");
      CHECK_THAT(strength_db(sediment, 100e3, 1500, degrees[i]), WithinAbs(expected_db[i], 0.1));
    }
  };
  check(sediment_of("rough rock").value(), {-8.8, -4.9, -4.0, -3.8, -4.2});
  check(sediment_of("cobble").value(), {-21.1, -13.7, -12.3, -11.7, -11.3});
  check(sediment_of("coarse sand").value(), {-27.2, -20.1, -18.9, -17.1, -10.8});
  check(sediment_of("medium sand").value(), {-29.8, -22.6, -21.3, -19.4, -9.8});
  check(sediment_of_grain_size(6.0), {-35.7, -29.9, -28.3, -27.4, -9.9});
  check(sediment_of("clay").value(), {-36.4, -30.1, -28.4, -27.4, -10.6});
}

TEST_CASE("above 100 kHz: the trends that the documentation states") {
  const auto trend = [](const SedimentParameters& sediment) {
    return strength_db(sediment, 400e3, 1500, 45) - strength_db(sediment, 100e3, 1500, 45);
  };
  CHECK_THAT(trend(sediment_of("medium sand").value()), WithinAbs(1.7, 0.1));
  CHECK_THAT(trend(sediment_of_grain_size(6.0)), WithinAbs(0.0, 0.1));
  CHECK_THAT(trend(sediment_of("rough rock").value()), WithinAbs(1.1, 0.1));
  CHECK_THAT(strength_db(sediment_of("medium sand").value(), 400e3, 1500, 90), WithinAbs(-16.0, 0.1));
}

TEST_CASE("all sediments are finite at 0-90 deg and 10-1000 kHz, smooth above 1 deg") {
  double greatest_step_db = 0.0;
  for (const auto& row : named_sediments()) {
    for (const double frequency_hz : frequencies_hz()) {
      INFO(row.name << " at " << frequency_hz << " Hz");
      const SedimentBackscatter law(row.parameters, frequency_hz, 1500);
      bool finite = true;
      double before_db = 0.0;
      for (int i = 0; i <= 900; ++i) {
        const auto part = law.parts(0.1 * i * kDegree);
        for (const double value : {part.kirchhoff, part.composite, part.large_roughness, part.volume, part.total}) {
          finite = finite && std::isfinite(value) && value >= 0.0;
        }
        const double now_db = db(part.total);
        finite = finite && std::isfinite(now_db);
        if (i > 10) greatest_step_db = std::max(greatest_step_db, std::abs(now_db - before_db));
        before_db = now_db;
      }
      REQUIRE(finite);
    }
  }
  // 1.32 dB: clay at 10 kHz, 89.2 degrees, the flank of its narrow specular lobe.
  CHECK(greatest_step_db < 1.5);
}

TEST_CASE("angles outside 0-90 degrees are clamped, below 0.001 degrees to 0.001") {
  const SedimentBackscatter law(sediment_of("fine sand").value(), 100e3, 1500);
  CHECK(law(-0.1) == law(0.001 * kDegree));
  CHECK(law(0.0) == law(0.001 * kDegree));
  CHECK(law(std::nextafter(90 * kDegree, 4.0)) == law(90 * kDegree));
  CHECK(law(4.0) == law(90 * kDegree));
}

TEST_CASE("strength is blended roughness plus volume; blends stay between their parts") {
  for (const auto& row : named_sediments()) {
    const SedimentBackscatter law(row.parameters, 200e3, 1500);
    for (double degrees = 1.0; degrees <= 90.0; degrees += 1.0) {
      const auto part = law.parts(degrees * kDegree);
      CHECK(part.total == part.roughness + part.volume);
      CHECK(part.roughness <= std::max({part.kirchhoff, part.composite, part.large_roughness}) * (1 + 1e-12));
      CHECK(part.roughness >= std::min({part.kirchhoff, part.composite, part.large_roughness}) * (1 - 1e-12));
    }
  }
}

TEST_CASE("the Kirchhoff law at normal incidence is the closed form of its integral") {
  // For relief with the structure function C^2 r^(2 alpha) the integral is
  // |R90|^2 k^2 / (2 pi) Integral r exp(-2 k^2 C^2 r^(2 alpha)) dr
  // = |R90|^2 k^2 Gamma(1 / alpha) / (4 pi alpha (2 k^2 C^2)^(1 / alpha)). A wrong sign in b is 3.6 dB off.
  const auto sand = sediment_of("medium sand").value();
  const double alpha = sand.spectral_exponent / 2 - 1;
  const double k = 2 * std::numbers::pi * 60e3 / (100 * 1500);  // rad/cm
  const double C_squared = 2 * std::numbers::pi * sand.spectral_strength_cm4 * std::tgamma(2 - alpha) *
                           std::pow(2, -2 * alpha) / (alpha * (1 - alpha) * std::tgamma(1 + alpha));
  const double exact = std::norm(reflection_coefficient(sand, 90 * kDegree)) * k * k * std::tgamma(1 / alpha) /
                       (4 * std::numbers::pi * alpha * std::pow(2 * k * k * C_squared, 1 / alpha));
  CHECK(SedimentBackscatter(sand, 60e3, 1500).parts(90 * kDegree).kirchhoff == Approx(exact).epsilon(1e-9));
}

TEST_CASE("below 60 degrees, to 100 kHz, only rock exceeds a perfect diffuser") {
  // sigma <= sin^2 / pi. Rough rock exceeds it at low grazing at every frequency, rock from 45 kHz: section 2.1 of the
  // page.
  for (const auto& row : named_sediments()) {
    if (row.name == "rough rock" || row.name == "rock") continue;
    for (const double frequency_hz : {10e3, 20e3, 40e3, 80e3}) {
      const SedimentBackscatter law(row.parameters, frequency_hz, 1500);
      for (double degrees = 1.0; degrees < 60.0; degrees += 1.0) {
        INFO(row.name << " at " << frequency_hz << " Hz, " << degrees << " degrees");
        CHECK(law(degrees * kDegree) <= std::pow(std::sin(degrees * kDegree), 2) / std::numbers::pi);
      }
    }
  }
}

TEST_CASE("energy: the specular lobe holds no more than the seabed reflects") {
  // A lobe of mirror-like facets, seen from where it came, holds 4 Integral sigma cos(g) dOmega = |R90|^2 (g
  // incidence).
  for (const auto& row : named_sediments()) {
    for (const double frequency_hz : frequencies_hz()) {
      const SedimentBackscatter law(row.parameters, frequency_hz, 1500);
      double energy = 0.0;
      const double step = 0.05 * kDegree;
      for (double g = 0.5 * step; g < 50 * kDegree; g += step) {
        energy += 4 * law.parts(90 * kDegree - g).kirchhoff * std::cos(g) * 2 * std::numbers::pi * std::sin(g) * step;
      }
      INFO(row.name << " at " << frequency_hz << " Hz: " << energy);
      CHECK(energy <= std::norm(reflection_coefficient(row.parameters, 90 * kDegree)));
    }
  }
}

TEST_CASE("the cap makes rough rock diffuse below 60 degrees, unchanged near normal") {
  const auto rock = sediment_of("rough rock").value();
  const double diffuse = std::norm(reflection_coefficient(rock, 90 * kDegree)) / std::numbers::pi;
  for (const double frequency_hz : {100e3, 400e3, 900e3}) {
    const SedimentBackscatter free(rock, frequency_hz, 1500);
    const auto volume = [&](double at) { return free.parts(at).volume; };
    const auto capped = law_of(CappedSediment{rock}, frequency_hz, 1500);
    double before_db = db(capped(1 * kDegree));
    for (double degrees = 1.1; degrees < 90.0; degrees += 0.1) {
      const double at = degrees * kDegree;
      if (degrees < 60.0) CHECK(capped(at) - volume(at) <= diffuse * std::pow(std::sin(at), 2) * (1 + 1e-9));
      if (degrees > 75.01) CHECK(capped(at) == free(at));
      CHECK(std::abs(db(capped(at)) - before_db) < 1.5);
      before_db = db(capped(at));
    }
  }
  // What never exceeds it stays as it is.
  const auto clay = sediment_of("clay").value();
  CHECK(law_of(CappedSediment{clay}, 300e3, 1500)(0.5) == law_of(clay, 300e3, 1500)(0.5));
}

TEST_CASE("in range is what the report vouches for") {
  auto sand = sediment_of("medium sand").value();
  CHECK(in_range(sand, 100e3));
  CHECK_FALSE(in_range(sand, 101e3));
  CHECK_FALSE(in_range(sand, 9e3));
  sand.density_ratio = 3.1;
  CHECK_FALSE(in_range(sand, 50e3));
}

TEST_CASE("any seabed inside the report's limits, and well outside, gives finite strengths") {
  std::mt19937 draw(7);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(draw()) / static_cast<double>(std::mt19937::max()));
  };
  for (int i = 0; i < 400; ++i) {
    const SedimentParameters sediment{.density_ratio = between(0.5, 5.0),
                                      .sound_speed_ratio = between(0.5, 4.0),
                                      .loss = std::pow(10.0, between(-6.0, 0.0)),
                                      .volume_parameter = between(0.0, 1.0),
                                      .spectral_exponent = between(2.05, 3.95),
                                      .spectral_strength_cm4 = std::pow(10.0, between(-8.0, 1.0))};
    const SedimentBackscatter law(sediment, std::pow(10.0, between(3.0, 6.3)), between(1400, 1600));
    for (const double degrees : {0.0, 0.5, 5.0, 39.99, 40.0, 66.0, 89.0, 90.0}) {
      const double sigma = law(degrees * kDegree);
      INFO("seabed " << i << " at " << degrees << " degrees");
      REQUIRE(std::isfinite(sigma));
      REQUIRE(sigma > 0.0);
    }
  }
}

TEST_CASE("parameters that the formulae cannot take are refused, with what is allowed") {
  auto sediment = sediment_of("clay").value();
  sediment.loss = 0.0;
  CHECK_THROWS_WITH(SedimentBackscatter(sediment, 1e5, 1500), "loss 0.000000: allowed is a positive number");
  sediment = sediment_of("clay").value();
  sediment.spectral_exponent = 4.0;
  CHECK_THROWS_WITH(SedimentBackscatter(sediment, 1e5, 1500), "spectral exponent 4.000000: allowed is between 2 and 4");
  CHECK_THROWS(SedimentBackscatter(sediment_of("clay").value(), 0.0, 1500));
  CHECK_THROWS(SedimentBackscatter(sediment_of("clay").value(), 1e5, std::nan("")));
}
