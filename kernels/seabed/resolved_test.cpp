#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "kernels/base/random/stream.h"
#include "kernels/seabed/backscatter.h"
#include "kernels/seabed/law.h"
#include "kernels/seabed/table.h"

using namespace ensonify::seabed;
using Catch::WithinAbs;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

double db(double ratio) { return 10.0 * std::log10(ratio); }

/// What facets with slopes drawn at random return from a unit of the plane's area, in dB.
double drawn_db(const Law& facets, double mean_square_slope, double grazing_rad) {
  static const ensonify::random::Stream draws(4, "slopes");
  constexpr std::uint64_t kFacets = 5'000;
  double sum = 0.0;
  for (std::uint64_t i = 0; i < kFacets; ++i) {
    const auto [east, north] = draws.normal_pair(i);
    const double each = std::sqrt(0.5 * mean_square_slope);
    const double area = std::hypot(1.0, each * east, each * north);
    const double sine = (std::sin(grazing_rad) + each * east * std::cos(grazing_rad)) / area;
    if (sine > 0.0) sum += area * facets(std::asin(std::min(sine, 1.0)));
  }
  return db(sum / static_cast<double>(kFacets));
}

/// Mean square slope of facets between posts of a sediment's relief, 2 C^2 d^(2 alpha - 2), d in cm.
double slope_of_posts(const SedimentParameters& sediment, double post_spacing_m) {
  const double alpha = 0.5 * sediment.spectral_exponent - 1.0;
  const double C_squared = 2.0 * std::numbers::pi * sediment.spectral_strength_cm4 * std::tgamma(2.0 - alpha) *
                           std::pow(2.0, -2.0 * alpha) / (alpha * (1.0 - alpha) * std::tgamma(1.0 + alpha));
  return 2.0 * C_squared * std::pow(100.0 * post_spacing_m, 2.0 * alpha - 2.0);
}

}  // namespace

TEST_CASE("facets leave mirrors the rest of Gaussian slopes: mean squares add") {
  // Whole 0.03, facets 0.01: 0.02 are left. Exact for small slopes; tilting a tilted facet is of their fourth order.
  const auto gaussian = [](double mean_square) {
    return [=](double grazing_rad) { return facet_backscatter(std::sin(grazing_rad), mean_square); };
  };
  const Law facets = law_of_facets(gaussian(0.03), 0.01), left = gaussian(0.02);
  for (const double grazing_deg : {78.0, 82.0, 86.0, 90.0}) {
    INFO(grazing_deg);
    CHECK_THAT(db(facets(grazing_deg * kDegree)), WithinAbs(db(left(grazing_deg * kDegree)), 0.2));
  }
  CHECK(db(gaussian(0.03)(90 * kDegree)) < db(left(90 * kDegree)) - 1.7);
}

TEST_CASE("mesh facets return the plane's law on average, and not when they use it as is") {
  double most_counted_twice_db = 0.0;
  int cases = 0;
  for (const char* name : {"rock", "coarse sand", "medium sand", "very fine sand", "clay"}) {
    for (const double frequency_hz : {100e3, 300e3}) {
      for (const double post_spacing_m : {0.1, 0.25}) {
        const auto sediment = sediment_of(name).value();
        const double mean_square = slope_of_posts(sediment, post_spacing_m);
        // Else the mesh alone is steeper than the law takes the seabed for: no facet can make up for that.
        const double laws_own = SedimentBackscatter(sediment, frequency_hz, 1500.0).rms_slope();
        if (mean_square > laws_own * laws_own) continue;
        ++cases;
        const Law whole = law_of(sediment, frequency_hz, 1500.0);
        const Law facets = law_of(MeshedSediment{sediment, mean_square}, frequency_hz, 1500.0);
        for (const double grazing_deg : {20.0, 45.0, 70.0, 83.0, 90.0}) {
          const double plane_db = db(whole(grazing_deg * kDegree));
          INFO(name << ", " << frequency_hz << " Hz, posts " << post_spacing_m << " m, " << grazing_deg << " degrees");
          // 5,000 draws of a lobe about as wide as the slopes scatter by 0.06 dB; the rest is what the rounds leave.
          CHECK_THAT(drawn_db(facets, mean_square, grazing_deg * kDegree), WithinAbs(plane_db, 0.3));
        }
        const double right_angle = 90.0 * kDegree;
        const double twice_db = db(whole(right_angle)) - drawn_db(whole, mean_square, right_angle);
        most_counted_twice_db = std::max(most_counted_twice_db, twice_db);
      }
    }
  }
  CHECK(cases >= 17);
  CHECK(most_counted_twice_db > 0.9);
}

TEST_CASE("near grazing the change is held to 6 dB, and no strength is lost") {
  const auto sand = sediment_of("medium sand").value();
  const Law whole = law_of(sand, 300e3, 1500.0);
  const Law facets = law_of_facets(whole, slope_of_posts(sand, 0.1));
  for (int i = 0; i <= 900; ++i) {
    const double grazing = 0.1 * i * kDegree;
    REQUIRE(std::abs(db(facets(grazing) / whole(grazing))) < 6.01);
  }
  const BackscatterTable table(facets);
  CHECK(table.error_db() <= 0.05);
}

TEST_CASE("without slopes the law is the plane's; slopes that cannot be are refused") {
  const Law whole = law_of(*sediment_of("clay"), 200e3, 1500.0);
  const Law same = law_of(MeshedSediment{*sediment_of("clay"), 0.0}, 200e3, 1500.0);
  for (const double grazing_deg : {0.0, 5.0, 45.0, 90.0})
    CHECK(same(grazing_deg * kDegree) == whole(grazing_deg * kDegree));
  for (const double wrong : {-0.1, 0.51, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(law_of_facets(whole, wrong), std::invalid_argument);
}
