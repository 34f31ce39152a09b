#include "kernels/instruments/inertial/imu.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/instruments/inertial/testing/allan.h"

using namespace ensonify;
using namespace ensonify::inertial;

namespace {

constexpr double kInterval_s = 0.01;
const frames::Vec3 kSteady(0.7310585786, -0.1192029220, 0.4013123399);  // no multiple of any quantum below

/// Readings of the first axis.
std::vector<double> readings_of(const TriadErrors& errors, std::size_t count) {
  Triad triad(errors, random::Stream(5, "allan"));
  std::vector<double> readings(count);
  for (double& reading : readings) reading = triad.increment(kSteady, kInterval_s).x() / kInterval_s;
  return readings;
}

}  // namespace

TEST_CASE("each noise has the Allan deviation of its kind within 5 %") {
  // 2^19 readings. The shortest record has 2^19 / 2^12 = 128 means; overlapping, the deviation strays by at most
  // 1 / sqrt(2 * 128) = 6 % there, so means of up to 2^10 readings (3 %) are judged, and the seed is fixed.
  constexpr std::size_t kCount = 1 << 19;
  const std::vector<std::size_t> sizes{16, 64, 256, 1024};
  SECTION("white noise") {
    for (const auto& p : allan_deviation(readings_of({.random_walk = 3e-4}, kCount), kInterval_s, sizes)) {
      CHECK(p.deviation == Approx(allan_of_white(3e-4, p.time_s)).epsilon(0.05));
    }
  }
  SECTION("rate random walk") {
    for (const auto& p : allan_deviation(readings_of({.rate_random_walk = 2e-5}, kCount), kInterval_s, sizes)) {
      CHECK(p.deviation == Approx(allan_of_rate_random_walk(2e-5, p.time_s)).epsilon(0.05));
    }
  }
  SECTION("Gauss-Markov bias, on both sides of its peak") {
    const TriadErrors errors{.bias_sigma = 1e-3, .bias_time_s = 1.0};
    for (const auto& p : allan_deviation(readings_of(errors, kCount), kInterval_s, sizes)) {
      CHECK(p.deviation == Approx(allan_of_gauss_markov(1e-3, 1.0, p.time_s)).epsilon(0.05));
    }
  }
  SECTION("quantisation") {
    // The rounding of each sample is random when the motion is: here by many quanta from sample to sample.
    const double quantum = 1e-4;
    Triad triad({.quantum = quantum}, random::Stream(5, "allan"));
    const random::Stream motion(6, "motion");
    std::vector<double> errors(kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
      const double rate = 0.2 * motion.normal(i);
      errors[i] = triad.increment({rate, 0.0, 0.0}, kInterval_s).x() / kInterval_s - rate;
    }
    for (const auto& p : allan_deviation(errors, kInterval_s, std::vector<std::size_t>{4, 16, 64, 256})) {
      CHECK(p.deviation == Approx(allan_of_quantum(quantum, p.time_s)).epsilon(0.05));
    }
  }
}

TEST_CASE("quantisation loses nothing: the integral stays within one quantum of the truth") {
  Triad triad({.quantum = 1e-3}, random::Stream(1, "q"));
  frames::Vec3 sum = frames::Vec3::Zero();
  for (int i = 1; i <= 1000; ++i) {
    sum += triad.increment(kSteady, kInterval_s);
    REQUIRE((sum - i * kInterval_s * kSteady).cwiseAbs().maxCoeff() < 1e-3 + 1e-12);
  }
}

TEST_CASE("without errors the triad reports the truth") {
  Triad triad({}, random::Stream(1, "t"));
  CHECK(triad.increment(kSteady, 0.5) == 0.5 * kSteady);
}

TEST_CASE("what is drawn at switching on has its stated spread, and stays") {
  // 3 x 500 draws: their standard deviation strays by 1 / sqrt(3000) = 1.8 %; four times that is allowed.
  double bias = 0.0, scale = 0.0, crosstalk = 0.0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Triad biased({.turn_on_bias = 0.2}, random::Stream(seed, "b"));
    const frames::Vec3 first = biased.increment(frames::Vec3::Zero(), 1.0);
    REQUIRE(first == biased.increment(frames::Vec3::Zero(), 1.0));
    bias += first.squaredNorm();
    Triad scaled({.scale_factor = 0.01}, random::Stream(seed, "s"));
    scale += (scaled.increment(kSteady, 1.0) - kSteady).cwiseQuotient(kSteady).squaredNorm();
    Triad misaligned({.misalignment_rad = 0.02}, random::Stream(seed, "m"));
    const frames::Vec3 seen = misaligned.increment(frames::Vec3::UnitX(), 1.0);
    REQUIRE(seen.x() == 1.0);
    crosstalk += 1.5 * (seen.y() * seen.y() + seen.z() * seen.z());
  }
  CHECK(std::sqrt(bias / 1500) == Approx(0.2).epsilon(0.072));
  CHECK(std::sqrt(scale / 1500) == Approx(0.01).epsilon(0.072));
  CHECK(std::sqrt(crosstalk / 1500) == Approx(0.02).epsilon(0.09));  // of 1000 draws
}

TEST_CASE("switching one error off leaves the draws of the others as they were") {
  const TriadErrors all{0.01, 0.02, 0.1, 0.05, 10.0, 0.003, 0.004, 0.0};
  const auto total = [](const TriadErrors& errors) {
    Triad triad(errors, random::Stream(3, "x"));
    frames::Vec3 sum = frames::Vec3::Zero();
    for (int i = 0; i < 10; ++i) sum += triad.increment(kSteady, 0.1);
    return frames::Vec3(sum - kSteady);
  };
  // Errors add up, so what they leave alone sums to what they leave together.
  frames::Vec3 parts = frames::Vec3::Zero();
  parts += total({.scale_factor = 0.01}) + total({.misalignment_rad = 0.02}) + total({.turn_on_bias = 0.1});
  parts += total({.bias_sigma = 0.05, .bias_time_s = 10.0}) + total({.random_walk = 0.003});
  parts += total({.rate_random_walk = 0.004});
  CHECK((total(all) - parts).norm() < 1e-12);
}
