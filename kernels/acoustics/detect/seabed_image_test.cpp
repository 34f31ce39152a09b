#include "kernels/acoustics/detect/seabed_image.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

using namespace ensonify::detect;
using Catch::WithinAbs;

namespace {
constexpr double kDeg = std::numbers::pi / 180.0;
}

TEST_CASE("a level Lambert seabed comes out at its coefficient") {
  // Peak levels of a 1 x 1 degree Mills cross, SL 220, 100 us, 0.07 dB/m, 20 m, mu -25: integrated over the patterns
  // (PHYSICS.md section 1.1). Near nadir the assumed law is a straight line to 0 dB, Lambert's cosine is above it by up
  // to 0.24 dB; the closed areas are right within 0.1 dB beyond 35 degrees and within 0.3 dB at 30. At nadir the pulse
  // ends 5 degrees out, where 2.3 % of each pattern are still to come: 0.2 dB.
  const FlatteningModel model{.absorption_dbpm = 0.07};
  const struct {
    double angle_deg, level_db, margin_db;
  } anchors[] = {{0, 131.86, 0.25}, {30, 124.20, 0.3}, {45, 117.65, 0.1}, {60, 107.68, 0.1}};
  for (const auto& a : anchors) {
    const double range = 20.0 / std::cos(a.angle_deg * kDeg);
    INFO(a.angle_deg << " degrees");
    CHECK_THAT(flattened_reflectivity_db(model, std::pow(10, a.level_db / 20), range), WithinAbs(-25, a.margin_db));
  }
}

TEST_CASE("the assumed law is a line to the crossover and Lambert beyond") {
  const FlatteningModel model{.normal_excess_db = 12.0};
  CHECK(assumed_angular_db(model, 20.0) == Approx(12.0));
  CHECK(assumed_angular_db(model, 15.0) == Approx(12.0));  // nearer than the nearest
  const double at_25 = 20 * std::log10(std::cos(25 * kDeg));
  CHECK(assumed_angular_db(model, 20 / std::cos(12.5 * kDeg)) == Approx(0.5 * (12 + at_25)));
  CHECK_THAT(assumed_angular_db(model, 20 / std::cos(24.9999 * kDeg)), WithinAbs(at_25, 1e-3));
  CHECK_THAT(assumed_angular_db(model, 20 / std::cos(25.0001 * kDeg)), WithinAbs(at_25, 1e-3));
  CHECK(assumed_angular_db(model, 40.0) == Approx(20 * std::log10(0.5)));
}

TEST_CASE("the area grows without a step from the beam's to the pulse's") {
  const FlatteningModel model;
  double before = assumed_area_db(model, 10.0);
  for (double range = 10.0; range < 60.0; range += 0.01) {
    const double area = assumed_area_db(model, range);
    REQUIRE(std::isfinite(area));
    // Per cm of range: at most what the strip loses where it takes over, 10 log10 of sine by sine.
    REQUIRE(std::abs(area - before) < 0.1);
    before = area;
  }
}

TEST_CASE("the range law is what its name says, and undone by it") {
  const RangeLaw law{30.0, 0.05, 7.0};
  CHECK(gain_db(law, 10.0) == Approx(30 + 1 + 7));
  CHECK(range_law_reflectivity_db(law, 215.0, 1e5, 10.0) == Approx(100 - 215 + 38));
  // A wrong absorption leaves the trend 2 (alpha' - alpha) R.
  const RangeLaw wrong{30.0, 0.06, 7.0};
  CHECK(gain_db(wrong, 80.0) - gain_db(law, 80.0) == Approx(2 * 0.01 * 80));
}

TEST_CASE("a snippet becomes an image sample by sample, silence included") {
  const std::vector<float> snippet{1e5F, 0.0F, 1e4F};
  std::vector<float> flat(3), ranged(3);
  const FlatteningModel model;
  const RangeLaw law;
  seabed_image_db(model, snippet, 25.0, 0.05, flat);
  seabed_image_db(law, 220.0, snippet, 25.0, 0.05, ranged);
  for (std::size_t k = 0; k < 3; ++k) {
    const double range = 25.0 + 0.05 * static_cast<double>(k);
    CHECK(flat[k] == Approx(flattened_reflectivity_db(model, snippet[k], range)));
    CHECK(ranged[k] == Approx(range_law_reflectivity_db(law, 220.0, snippet[k], range)));
    CHECK(std::isfinite(flat[k]));
  }
  std::vector<float> small(2);
  CHECK_THROWS_WITH(seabed_image_db(model, snippet, 25.0, 0.05, small),
                    "seabed_image_db: a snippet of 3 samples does not fit an image of 2");
  CHECK_THROWS_WITH(seabed_image_db(law, 220.0, snippet, 0.0, 0.05, flat),
                    Catch::Contains("first range 0.000000 m and step 0.050000 m must be above 0"));
}
