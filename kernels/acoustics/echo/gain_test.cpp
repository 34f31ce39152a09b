#include "kernels/acoustics/echo/gain.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/acoustics/echo/image.h"
#include "kernels/base/random/stream.h"

using namespace ensonify::echo;
using Catch::WithinAbs;

static std::vector<float> noise_upa(int rows, int samples, double level_db) {
  Image image;
  image.resize(rows, samples);
  const auto sd = static_cast<float>(std::sqrt(0.5 * std::pow(10.0, 0.1 * level_db)));
  ensonify::random::add_gaussian({1, "noise"}, 1, 0, sd, image.envelope_upa);
  std::vector<float> amplitude;
  amplitude_upa(image, amplitude);
  return amplitude;
}

TEST_CASE("a gain law is spreading, absorption, slope and offset, held outside its ranges") {
  const Sampling sampling{0.0, 1e-3, 400};  // 0.75 m per sample
  std::vector<float> gain;
  tvg_db({.spreading_db = 30,
          .absorption_dbpm = 0.05,
          .slope_db_per_100m = 4,
          .offset_db = -7,
          .start_range_m = 3,
          .stop_range_m = 150},
         sampling, gain);
  const auto law = [](double R) { return 30 * std::log10(R) + 0.1 * R + 0.04 * R - 7; };
  CHECK(gain[0] == Approx(law(3)));
  CHECK(gain[100] == Approx(law(75)));
  CHECK(gain[399] == Approx(law(150)));
  tvg_db({.spreading_db = 40, .min_db = 10, .max_db = 60, .step_db = 2}, sampling, gain);
  CHECK(gain[0] == 10);
  CHECK(gain[10] == Approx(36));  // 40 log 7.5 = 35.0 falls between steps
  CHECK(gain[399] == 60);
  for (const float g : gain) REQUIRE(std::fmod(g, 2.0F) == 0.0F);
  CHECK_THROWS_WITH(tvg_db({.start_range_m = 0}, sampling, gain), "a gain law needs a start range above 0 m");
}

TEST_CASE("the right law flattens, a wrong absorption leaves its trend") {
  // An echo that falls as 30 log R + 2 alpha R, alpha 0.07; the operator assumes 0.05: 2 (0.05 - 0.07) R is left.
  const Sampling sampling{20e-3, 1e-4, 1000};
  std::vector<float> right(1000), gain;
  for (int k = 0; k < 1000; ++k) {
    const double R = 750 * (20e-3 + 1e-4 * k);
    right[k] = float(std::pow(10, -0.05 * (30 * std::log10(R) + 0.14 * R - 150)));
  }
  std::vector<float> wrong = right;
  tvg_db({.spreading_db = 30, .absorption_dbpm = 0.07}, sampling, gain);
  apply_gain(gain, right);
  tvg_db({.spreading_db = 30, .absorption_dbpm = 0.05}, sampling, gain);
  apply_gain(gain, wrong);
  for (int k = 0; k < 1000; ++k) {
    const double R = 750 * (20e-3 + 1e-4 * k);
    REQUIRE_THAT(20 * std::log10(right[k]), WithinAbs(150, 1e-3));
    REQUIRE_THAT(20 * std::log10(wrong[k]), WithinAbs(150 - 0.04 * R, 1e-3));
  }
}

TEST_CASE("each row has the gain, and lifts noise with signal") {
  std::vector<float> amplitude = noise_upa(4, 5000, 40);
  const std::vector<float> before = amplitude;
  std::vector<float> gain_db(5000, 26.0F);
  gain_db[7] = -6.0F;
  apply_gain(gain_db, amplitude);
  double power = 0.0;
  for (const float p : amplitude) power += double(p) * double(p) / 20000;
  CHECK_THAT(10 * std::log10(power), WithinAbs(66, 0.12));  // 20,000 exponential powers: 4 sd of 0.7 %
  for (int row = 0; row < 4; ++row) {
    CHECK(amplitude[5000 * row + 7] == Approx(before[5000 * row + 7] * std::pow(10, -0.3)));
  }
  CHECK_THROWS_WITH(apply_gain(std::vector<float>(4999), amplitude), "a gain needs one value per sample");
}

TEST_CASE("counts are the nearest multiple of their step, and hold at their end") {
  std::vector<std::uint16_t> counts;
  amplitude_counts(std::vector<float>{0.0F, 0.24F, 0.26F, 3.0F, 1e9F}, 0.5, 12, counts);
  CHECK(counts == std::vector<std::uint16_t>{0, 0, 1, 6, 4095});
  CHECK_THROWS_WITH(amplitude_counts(std::vector<float>{1.0F}, 0.5, 17, counts), "counts have 1 to 16 bits");
  CHECK_THROWS_WITH(amplitude_counts(std::vector<float>{1.0F}, 0.0, 12, counts), "a count's step must be positive");
}

TEST_CASE("n bits err as a uniform error of one step") {
  const std::vector<float> amplitude = noise_upa(10, 4000, 30);  // 32 uPa rms: never near 255
  std::vector<std::uint16_t> counts;
  amplitude_counts(amplitude, 1.0, 8, counts);
  double error = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    error += std::pow(double(counts[i]) - double(amplitude[i]), 2) / 40000;
  CHECK(error == Approx(1.0 / 12).epsilon(0.02));  // 40,000 uniform errors: sd of the mean square 0.45 %
}
