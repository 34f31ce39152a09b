#include "kernels/echo/gain.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <limits>

#include "kernels/echo/noise.h"

using namespace ensonify::echo;

static Image ramp(int samples) {
  Image image;
  image.resize(1, samples);
  for (int k = 0; k < samples; ++k) image.row(0)[k] = {float(k) - samples / 2.0F, 0.3F * float(k)};
  return image;
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
  // An echo that falls as 30 log R + 2 alpha R, alpha 0.07; the operator believes 0.05: 2 (0.05 - 0.07) R is left.
  const Sampling sampling{20e-3, 1e-4, 1000};
  Image right, wrong;
  right.resize(1, 1000);
  for (int k = 0; k < 1000; ++k) {
    const double R = 750 * (20e-3 + 1e-4 * k);
    right.row(0)[k] = float(std::pow(10, -0.05 * (30 * std::log10(R) + 0.14 * R - 150)));
  }
  wrong = right;
  std::vector<float> gain;
  tvg_db({.spreading_db = 30, .absorption_dbpm = 0.07}, sampling, gain);
  apply_gain(gain, right);
  tvg_db({.spreading_db = 30, .absorption_dbpm = 0.05}, sampling, gain);
  apply_gain(gain, wrong);
  for (int k = 0; k < 1000; ++k) {
    const double R = 750 * (20e-3 + 1e-4 * k);
    REQUIRE(20 * std::log10(std::abs(right.row(0)[k])) == Approx(150).margin(1e-3));
    REQUIRE(20 * std::log10(std::abs(wrong.row(0)[k])) == Approx(150 - 0.04 * R).margin(1e-3));
  }
}

TEST_CASE("gain lifts noise with signal") {
  Image image;
  image.resize(4, 5000);
  add_noise(40, 1, {1, "noise"}, image);
  apply_gain(std::vector<float>(5000, 26.0F), image);
  double power = 0.0;
  for (const auto p : image.envelope_upa) power += std::norm(p) / 20000;
  CHECK(10 * std::log10(power) == Approx(66).margin(0.12));  // 20,000 exponential powers: 4 sd of 0.7 %
}

TEST_CASE("saturation keeps the phase and holds the magnitude") {
  Image image = ramp(100);
  const Image before = image;
  saturate(20.0, image);
  for (int k = 0; k < 100; ++k) {
    const auto was = before.row(0)[k], is = image.row(0)[k];
    REQUIRE(std::abs(is) == Approx(std::min(20.0F, std::abs(was))));
    REQUIRE(std::abs(is * std::conj(was) - std::abs(is) * std::abs(was)) < 1e-2F);
  }
  image = before;
  saturate(std::numeric_limits<double>::infinity(), image);
  CHECK(image.envelope_upa == before.envelope_upa);
}

TEST_CASE("n bits err as a uniform error of one step, and clip at their ends") {
  const Digitiser eight{8, 128.0};
  CHECK(eight.step_upa() == 1.0);
  Image image;
  image.resize(10, 4000);
  add_noise(30, 1, {1, "noise"}, image);  // sd 22 per part: clips never
  const Image before = image;
  digitise(eight, image);
  double error = 0.0;
  for (std::size_t i = 0; i < image.envelope_upa.size(); ++i) {
    REQUIRE(image.envelope_upa[i].real() == std::round(before.envelope_upa[i].real()));
    error += std::norm(image.envelope_upa[i] - before.envelope_upa[i]) / 40000;
  }
  CHECK(error == Approx(1.0 / 6).epsilon(0.02));  // of 80,000 uniform errors: sd of the mean square 0.3 %
  // A full-scale tone over this error is the textbook's 6.02 n + 1.76 dB (per part: half of each).
  CHECK(10 * std::log10(128.0 * 128.0 / 2 / (error / 2)) == Approx(6.02 * 8 + 1.76).margin(0.1));
  Image loud;
  loud.resize(1, 1);
  loud.row(0)[0] = {500.0F, -500.0F};
  digitise(eight, loud);
  CHECK(loud.row(0)[0] == std::complex<float>(127.0F, -128.0F));
  CHECK_THROWS_AS(digitise({1, 1.0}, loud), std::invalid_argument);
}

TEST_CASE("counts are the nearest multiple of their step") {
  std::vector<std::uint16_t> counts;
  amplitude_counts(std::vector<float>{0.0F, 0.24F, 0.26F, 3.0F, 1e9F}, 0.5, 12, counts);
  CHECK(counts == std::vector<std::uint16_t>{0, 0, 1, 6, 4095});
}

TEST_CASE("gain for the picture", "[.echo-gain-csv]") {
  // Echo and noise before and after gain of the right and a wrong absorption, 12 bits.
  const Sampling sampling{10e-3, 1e-4, 1900};
  std::puts("range_m,echo_db,right_gain_db,wrong_gain_db,right_db,wrong_db,steps_gain_db");
  std::vector<float> right, wrong, steps;
  tvg_db({.spreading_db = 30, .absorption_dbpm = 0.07, .offset_db = -60}, sampling, right);
  tvg_db({.spreading_db = 30, .absorption_dbpm = 0.05, .offset_db = -60}, sampling, wrong);
  tvg_db({.spreading_db = 30, .absorption_dbpm = 0.07, .offset_db = -60, .max_db = 12, .step_db = 2}, sampling, steps);
  Image image;
  image.resize(1, 1900);
  add_noise(95, 1, {1, "noise"}, image);
  for (int k = 0; k < 1900; ++k) {
    const double R = 750 * (10e-3 + 1e-4 * k);
    image.row(0)[k] += float(std::pow(10, 0.05 * (180 - 30 * std::log10(R) - 0.14 * R)));
  }
  Image with_right = image, with_wrong = image;
  apply_gain(right, with_right);
  apply_gain(wrong, with_wrong);
  digitise({12, 1e7}, with_right);
  digitise({12, 1e7}, with_wrong);
  const auto db = [](std::complex<float> p) { return 10 * std::log10(std::norm(p) + 1e-9); };
  for (int k = 0; k < 1900; k += 4) {
    std::printf("%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f\n", 750 * (10e-3 + 1e-4 * k), db(image.row(0)[k]), right[k],
                wrong[k], db(with_right.row(0)[k]), db(with_wrong.row(0)[k]), steps[k]);
  }
}
