#include "components/multibeam/relief_estimator.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/base/random/stream.h"

using namespace ensonify;

namespace {

/// A ping of 60 places half a metre apart with footprints of 1 m: level to place 29, beyond it heights of their own.
std::vector<ReliefEstimator::Sounding> ping(std::uint64_t number, double rough_m) {
  const random::Stream stream(1, "relief");
  std::vector<ReliefEstimator::Sounding> soundings;
  for (int place = 0; place < 60; ++place) {
    const double rise_m = place < 30 ? 0.0 : rough_m * stream.normal(number, static_cast<std::uint64_t>(place));
    soundings.push_back({place, {0.5 * place, -20.0 + rise_m, 1.0, 0.0}});
  }
  return soundings;
}

}  // namespace

TEST_CASE("unresolved relief is estimated on rough seabed, up to the edge of the swath") {
  ReliefEstimator estimator;
  CHECK(estimator.sd_m(30, 1.0, 1.0) == 0.0);
  for (std::uint64_t n = 0; n < 100; ++n) estimator.take(ping(n, 0.1));
  CHECK(estimator.sd_m(10, 1.0, 1.0) == 0.0);
  // Independent heights bend by sqrt(70) of their deviation. Some 43 pings' weight x 9 places: within 7 %, at the edge
  // within 10 %; three times that.
  const double expected = 0.1 * std::sqrt(70.0 * uncertainty::unresolved_share(0.625, 1.0));
  CHECK(estimator.sd_m(45, 1.0, 1.0) == Approx(expected).epsilon(0.2));
  CHECK(estimator.sd_m(59, 1.0, 1.0) == Approx(expected).epsilon(0.3));
  // A footprint twice as wide misses 2^0.625 as much, one that is short along the track less.
  CHECK(estimator.sd_m(45, 2.0, 1.0) == Approx(std::exp2(0.625) * estimator.sd_m(45, 1.0, 1.0)));
  CHECK(estimator.sd_m(45, 1.0, 0.3) < 0.8 * estimator.sd_m(45, 1.0, 1.0));
  CHECK(estimator.sd_m(45, 1.0, 9.0) == estimator.sd_m(45, 1.0, 4.0));

  for (std::uint64_t n = 100; n < 600; ++n) estimator.take(ping(n, 0.0));  // 0.98^500: forgotten
  CHECK(estimator.sd_m(45, 1.0, 1.0) < 0.01 * expected);
}

TEST_CASE("one broken longer profile in twenty does not decide for the swath's edge") {
  // Footprints of 4 m: the last 16 of 60 places know no bend of their own, but where the last sounding lies 8 m farther
  // out, and 4 m up.
  const random::Stream stream(2, "relief");
  ReliefEstimator estimator;
  for (std::uint64_t n = 0; n < 100; ++n) {
    std::vector<ReliefEstimator::Sounding> soundings;
    for (int place = 0; place < 60; ++place) {
      const double rise_m = 0.1 * stream.normal(n, static_cast<std::uint64_t>(place));
      soundings.push_back({place, {0.5 * place, -20.0 + rise_m, 4.0, 0.0}});
    }
    if (n % 20 == 0) {
      soundings.back().point.across_m += 8.0;
      soundings.back().point.height_m += 4.0;
    }
    estimator.take(soundings);
  }
  const double expected = 0.1 * std::sqrt(70.0 * uncertainty::unresolved_share(0.625, 1.0));
  for (const int place : {40, 50, 59}) CHECK(estimator.sd_m(place, 4.0, 1.0) == Approx(expected).epsilon(0.3));
}

TEST_CASE("a single ping too short to curve changes no estimate") {
  ReliefEstimator estimator;
  estimator.take(std::vector<ReliefEstimator::Sounding>{{3, {0.0, -20.0, 1.0, 0.0}}, {4, {0.5, -20.5, 1.0, 0.0}}});
  CHECK(estimator.sd_m(3, 1.0, 1.0) == 0.0);
  estimator.take({});
  CHECK(estimator.sd_m(100, 1.0, 1.0) == 0.0);
}
