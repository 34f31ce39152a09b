#include "kernels/instruments/inertial/testing/allan.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

using namespace ensonify::inertial;
using Catch::WithinAbs;

TEST_CASE("the overlapping Allan deviation of the handbook's nine readings") {
  // The test suite of [Riley2008], sec. 12: nine fractional frequencies of NBS Monograph 140, annex 8.E, and their
  // overlapping deviations at one and two samples.
  const std::vector<double> readings{892, 809, 823, 798, 671, 644, 883, 903, 677};
  const std::vector<std::size_t> sizes{1, 2};
  const auto points = allan_deviation(readings, 1.0, sizes);
  CHECK(points[0].deviation == Approx(91.22945).epsilon(1e-5));
  CHECK(points[1].deviation == Approx(85.95287).epsilon(1e-5));
  CHECK(points[1].time_s == 2.0);
}

TEST_CASE("a steady drift of the reading gives R tau / sqrt 2, and a constant gives nothing") {
  std::vector<double> ramp(1000);
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = 5.0 + 0.1 * 0.02 * static_cast<double>(i);
  const std::vector<std::size_t> sizes{1, 10, 100};
  for (const AllanPoint& point : allan_deviation(ramp, 0.02, sizes)) {
    CHECK(point.deviation == Approx(0.1 * point.time_s / std::sqrt(2.0)));
  }
  for (const AllanPoint& point : allan_deviation(std::vector<double>(1000, 3.0), 0.02, sizes)) {
    CHECK_THAT(point.deviation, WithinAbs(0, 1e-10));
  }
}

TEST_CASE("a Gauss-Markov bias has rate random walk, then a peak, then white noise") {
  const double sigma = 2.0, time_s = 100.0;
  const double start = allan_of_gauss_markov(sigma, time_s, 0.01);
  CHECK(start == Approx(allan_of_rate_random_walk(sigma * std::sqrt(2.0 / time_s), 0.01)).epsilon(1e-4));
  const double end = allan_of_gauss_markov(sigma, time_s, 1e6);
  CHECK(end == Approx(allan_of_white(sigma * std::sqrt(2.0 * time_s), 1e6)).epsilon(1e-4));
  CHECK(allan_of_gauss_markov(sigma, time_s, 0.0999) ==  // either side of the switch between series and formula
        Approx(allan_of_gauss_markov(sigma, time_s, 0.1001)).epsilon(2e-3));
  const double peak = allan_of_gauss_markov(gauss_markov_sigma_of_instability(1.0), time_s, 1.89 * time_s);
  CHECK(peak == Approx(0.664).epsilon(1e-4));
  CHECK(allan_of_gauss_markov(1.0, time_s, 1.7 * time_s) < allan_of_gauss_markov(1.0, time_s, 1.89 * time_s));
  CHECK(allan_of_gauss_markov(1.0, time_s, 2.1 * time_s) < allan_of_gauss_markov(1.0, time_s, 1.89 * time_s));
}

TEST_CASE("what cannot be averaged is refused") {
  const std::vector<double> readings(10, 0.0);
  CHECK_THROWS_AS(allan_deviation(readings, 1.0, std::vector<std::size_t>{6}), std::invalid_argument);
  CHECK_THROWS_AS(allan_deviation(readings, 1.0, std::vector<std::size_t>{0}), std::invalid_argument);
  CHECK_THROWS_AS(allan_deviation(readings, 0.0, std::vector<std::size_t>{1}), std::invalid_argument);
  CHECK(octaves(100) == std::vector<std::size_t>{1, 2, 4, 8});
}
