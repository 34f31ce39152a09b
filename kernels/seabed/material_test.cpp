#include "kernels/seabed/material.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "kernels/seabed/law.h"

using namespace ensonify::seabed;
using Catch::WithinAbs;

namespace {

constexpr double kPi = std::numbers::pi;

/// Integral over the insonified half of a sphere of radius a.
double sphere_cross_section_m2(const Law& law, double radius_m) {
  const int n = 20000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double g = (i + 0.5) * 0.5 * kPi / n;  // incidence
    sum += law(0.5 * kPi - g) * 2.0 * kPi * radius_m * radius_m * std::sin(g) * (0.5 * kPi / n);
  }
  return sum;
}

}  // namespace

TEST_CASE("normal reflection: rigid 1, steel 0.94, concrete 0.68, oak 0.31") {
  // (Z - 1.54) / (Z + 1.54)
  CHECK(normal_reflection(material_of("rigid").value()) == 1.0);
  CHECK_THAT(normal_reflection(material_of("metal").value()), WithinAbs(0.935, 0.001));
  CHECK_THAT(normal_reflection(material_of("concrete").value()), WithinAbs(0.677, 0.001));
  CHECK_THAT(normal_reflection(material_of("wood").value()), WithinAbs(0.306, 0.001));
  CHECK_FALSE(material_of("cheese").has_value());
}

TEST_CASE("a rigid sphere of facets has the target strength of the closed form") {
  // The finite slopes (rms 0.1) widen the lobe: 3/4 s^2 too much at most, 0.03 dB.
  const auto law = law_of(material_of("rigid").value(), 300e3, 1500);
  for (const double radius_m : {0.1, 0.5, 2.0}) {
    CHECK_THAT(10 * std::log10(sphere_cross_section_m2(law, radius_m)),
               WithinAbs(sphere_target_strength_db(radius_m), 0.05));
  }
  CHECK(sphere_target_strength_db(2.0) == 0.0);
  CHECK_THROWS_WITH(sphere_target_strength_db(0.0), "radius in m 0.000000: allowed is above 0");
}

TEST_CASE("a rigid sphere's closed form is within 0.7 dB of the series from ka = 10 on") {
  // Echo of a plane wave, relative to a / 2: |2 / ka Sum (2n + 1) (-1)^n j_n' / h_n'|.
  const auto slope = [](auto bessel, unsigned n, double x) {
    return n == 0 ? -bessel(1, x) : bessel(n - 1, x) - (n + 1) / x * bessel(n, x);
  };
  const auto j = [](unsigned n, double x) { return std::sph_bessel(n, x); };
  const auto y = [](unsigned n, double x) { return std::sph_neumann(n, x); };
  double greatest_db = 0.0;
  for (double ka = 10.0; ka < 60.0; ka += 0.3) {
    std::complex<double> sum = 0.0;
    for (unsigned n = 0; n < static_cast<unsigned>(ka) + 20; ++n) {
      const std::complex<double> share = slope(j, n, ka) / std::complex(slope(j, n, ka), slope(y, n, ka));
      sum += (2.0 * n + 1.0) * (n % 2 == 0 ? 1.0 : -1.0) * share;
    }
    greatest_db = std::max(greatest_db, std::abs(20 * std::log10(std::abs(2.0 / ka * sum))));
  }
  CHECK(greatest_db < 0.7);
  CHECK(greatest_db > 0.1);  // the creeping wave is in the series
}

TEST_CASE("a material returns the energy that its impedance reflects, neither more nor less") {
  // Facets: 4 Integral sigma cos g dOmega over incidence g (what they hold, seen from where it came).
  // Lambert: sigma = mu sin^2 holds mu pi.
  for (const auto& row : named_materials()) {
    auto facets_only = row.material;
    facets_only.diffuse = 0.0;
    auto lambert_only = row.material;
    lambert_only.diffuse = 1.0;
    double facets = 0.0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) {
      const double g = (i + 0.5) * 0.5 * kPi / n;
      facets += 4.0 * material_backscatter(facets_only, 0.5 * kPi - g) * std::cos(g) * 2.0 * kPi * std::sin(g) *
                (0.5 * kPi / n);
    }
    const double reflected = std::pow(normal_reflection(row.material), 2);
    INFO(row.name);
    CHECK(facets == Approx(reflected).epsilon(1e-4));
    CHECK(material_backscatter(lambert_only, 0.5 * kPi) * kPi == Approx(reflected));
  }
}

TEST_CASE("tissue has the stated target strength: exactly for a sphere") {
  const double radius_m = 0.4;
  const Tissue diver{.target_strength_db = -20.0, .surface_area_m2 = 4 * kPi * radius_m * radius_m};
  CHECK_THAT(10 * std::log10(sphere_cross_section_m2(law_of(diver, 100e3, 1500), radius_m)), WithinAbs(-20.0, 1e-3));
  CHECK_THROWS(law_of(Tissue{-20.0, 0.0}, 100e3, 1500));
}

TEST_CASE("GSAB: its parts, alone and together") {
  const Gsab curve{.specular = 0.1,
                   .specular_width_rad = 0.05,
                   .diffuse = 0.01,
                   .diffuse_exponent = 2.0,
                   .transition = 0.02,
                   .transition_width_rad = 0.4};
  CHECK(gsab_backscatter(curve, kPi / 2) == Approx(0.13));
  CHECK(gsab_backscatter({.diffuse = 0.01}, kPi / 6) == Approx(0.0025));  // Lambert at 30 degrees grazing
  CHECK(gsab_backscatter({.specular = 1.0, .specular_width_rad = 0.2}, kPi / 2 - 0.2) == Approx(std::exp(-0.5)));
  CHECK(gsab_backscatter(curve, 7.0) == gsab_backscatter(curve, kPi / 2));
}

TEST_CASE("materials and curves that have no value are refused") {
  CHECK_THROWS_WITH(material_backscatter({46.0, 0.0, 0.1}, 1.0), "rms slope 0.000000: allowed is above 0");
  CHECK_THROWS_WITH(material_backscatter({46.0, 0.1, 1.5}, 1.0), "diffuse share 1.500000: allowed is 0 to 1");
  CHECK_THROWS_WITH(material_backscatter({0.0, 0.1, 0.5}, 1.0), "impedance in Mrayl 0.000000: allowed is above 0");
  CHECK_THROWS(gsab_backscatter({.specular_width_rad = 0.0}, 1.0));
  CHECK(material_backscatter(material_of("rigid").value(), 0.0) == 0.0);
}
