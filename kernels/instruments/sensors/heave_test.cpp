#include "kernels/instruments/sensors/heave.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

using namespace ensonify::sensors;
using Catch::WithinAbs;
constexpr double kPi = std::numbers::pi;

namespace {

constexpr double kStep_s = 0.05;

/// Gain and phase lead at a period of motion, of H(s) = s^2 / (s^2 + 2 z w s + w^2) [Godhavn1998].
struct HeaveResponse {
  double gain;
  double phase_rad;  // positive: heave comes early
};

HeaveResponse heave_response(const HeaveSettings& settings, double period_s) {
  const double w = 2.0 * kPi / settings.cutoff_s;
  const std::complex<double> s(0.0, 2.0 * kPi / period_s);
  const std::complex<double> h = s * s / (s * s + 2.0 * settings.damping * w * s + w * w);
  return {std::abs(h), std::arg(h)};
}

/// Amplitude and phase of the filter's answer to a sine of 1 m, by correlation over whole periods after it has settled.
HeaveResponse answer(const HeaveSettings& settings, double period_s) {
  HeaveFilter filter(settings);
  const int settle = static_cast<int>(20 * settings.cutoff_s / kStep_s);
  const int per_period = static_cast<int>(std::round(period_s / kStep_s)), count = 10 * per_period;
  std::complex<double> sum = 0.0;
  for (int i = 0; i < settle + count; ++i) {
    const double phase = 2 * kPi * i / per_period;
    const double heave = filter.measure(std::sin(phase), 0.0, kStep_s);
    if (i >= settle) sum += heave * std::polar(2.0 / count, -phase);
  }
  sum *= std::complex<double>(0, 1);  // of a sine
  return {std::abs(sum), std::arg(sum)};
}

}  // namespace

TEST_CASE("heave of a swell has the gain and phase of the filter's transfer function") {
  // Trapezoids at 0.05 s err by (w h)^2 / 12: 1e-4 at a period of 8 s.
  for (const double period : {8.0, 12.0, 20.0, 40.0}) {
    const HeaveSettings settings{20.0, 0.7071};
    CAPTURE(period);
    CHECK(answer(settings, period).gain == Approx(heave_response(settings, period).gain).epsilon(1e-3));
    CHECK_THAT(answer(settings, period).phase_rad, WithinAbs(heave_response(settings, period).phase_rad, 1e-3));
  }
}

TEST_CASE("at its corner a filter damped by 0.707 keeps 0.707 and leads by a quarter turn") {
  CHECK(heave_response({20, std::sqrt(0.5)}, 20.0).gain == Approx(std::sqrt(0.5)));
  CHECK(heave_response({20, std::sqrt(0.5)}, 20.0).phase_rad == Approx(kPi / 2));
  CHECK_THAT(heave_response({20, 0.7071}, 2.0).gain, WithinAbs(1.0, 1e-3));
  CHECK(heave_response({20, 0.7071}, 200.0).gain == Approx(0.01).epsilon(0.02));  // (20 / 200)^2
}

TEST_CASE("heave holds no squat, draught or tide once the filter has settled") {
  HeaveFilter squat({15.0, 0.7071}), tide({15.0, 0.7071});
  double after_squat = 0.0, greatest_tide = 0.0;
  for (double t = 0; t < 600; t += kStep_s) {
    after_squat = squat.measure(t < 300 ? 0.0 : -0.4, 0.0, kStep_s);
    greatest_tide =
        std::max(greatest_tide, std::abs(tide.measure(2.0 * std::sin(2 * kPi * t / 44714.0), 0.0, kStep_s)));
  }
  CHECK(std::abs(after_squat) < 1e-6);
  // The tide's rise of 0.28 mm/s is a ramp that starts at once: a transient of 0.28e-3 * 15 / 2 pi at most.
  CHECK(greatest_tide < 7e-4);
}

TEST_CASE("a wrong vertical acceleration leaves a / w^2, and a transient when it goes") {
  HeaveFilter filter({20.0, 0.7071});
  double heave = 0.0;
  for (int i = 0; i < 4000; ++i) heave = filter.measure(5.0, 0.001, kStep_s);
  CHECK(heave == Approx(0.001 * std::pow(20.0 / (2 * kPi), 2)).epsilon(1e-3));
  for (int i = 0; i < 4000; ++i) heave = filter.measure(5.0, 0.0, kStep_s);
  CHECK(std::abs(heave) < 1e-5);
}

TEST_CASE("after a turn heave errs by centimetres and recovers; aiding removes most of it") {
  // 5 m/s round in 120 s: 0.26 m/s^2 across. Level leans by up to 0.0267 (1 - exp(-2)) rad.
  const auto greatest = [](double aided_share) {
    LevelError level({60.0, aided_share});
    HeaveFilter filter({20.0, 0.7071});
    double most = 0.0, last = 0.0;
    for (double t = 0; t < 900; t += kStep_s) {
      const double across = t > 60 && t < 180 ? 5.0 * 2 * kPi / 120 : 0.0;
      level.advance(across, kStep_s);
      last = filter.measure(0.0, level.vertical_error_mps2(across), kStep_s);
      most = std::max(most, std::abs(last));
    }
    CHECK(std::abs(last) < 1e-4);
    return most;
  };
  const double unaided = greatest(0.0);
  CHECK(unaided > 0.02);
  CHECK(unaided < 0.1);
  CHECK(greatest(0.9) < 0.2 * unaided);
}

TEST_CASE("level leans outwards in a turn to starboard, by a / g in the end") {
  LevelError level({10.0, 0.0});
  double lean = 0.0;
  for (int i = 0; i < 1000; ++i) lean = level.advance(0.5, 0.1);
  CHECK(lean == Approx(-std::atan(0.5 / 9.80665)).epsilon(1e-4));
}

TEST_CASE("delayed heave keeps swell far above the corner, without phase error, and no tide") {
  const auto window = delayed_heave_window(25.0, 75.0, 0.2);
  const auto heave_of = [&](double period, double phase) {
    std::vector<double> heights(window.size());
    const std::size_t middle_index = window.size() / 2;
    const auto middle = static_cast<double>(middle_index);
    for (std::size_t i = 0; i < heights.size(); ++i) {
      heights[i] = 3.0 + std::sin(2 * kPi * (static_cast<double>(i) - middle) * 0.2 / period + phase);
    }
    return delayed_heave_m(heights, window);
  };
  for (const double phase : {0.0, 0.5, 1.5}) {
    CHECK_THAT(heave_of(8.0, phase), WithinAbs(std::sin(phase), 0.003));
    CHECK_THAT(heave_of(14.0, phase), WithinAbs(std::sin(phase), 0.01));
    CHECK_THAT(heave_of(2000.0, phase), WithinAbs(0.0, 0.02));
  }
  // The running filter with the same corner has the swell of 14 s wrong by a fifth of its height.
  CHECK(std::abs(heave_response({25.0, 0.7071}, 14.0).phase_rad) > 0.5);
  CHECK_THROWS_AS(delayed_heave_m(std::vector<double>(4), std::vector<double>(4)), std::invalid_argument);
}
