#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "kernels/acoustics/detect/bottom.h"
#include "kernels/acoustics/detect/testing/plane_echo.h"

using namespace ensonify;
using namespace ensonify::detect;
using Catch::WithinAbs;

// Which returns are refused as the echo by way of the surface, and which are not.

namespace {

constexpr double kDeg = std::numbers::pi / 180.0;
constexpr double kDepth_m = 10.0;     // of the bottom below the head
constexpr double kHeadDepth_m = 1.0;  // so the second echo seems to come from 21 m
constexpr double kSecond_m = 21.0;
constexpr int kSamples = 1600, kPulse = 4;
constexpr double kPeriod_s = 25e-6;

/// A hundred and one beams of 1 degree, half a degree apart, each with steady noise of 0 dB and what is put into it.
struct Fan {
  static constexpr int kBeams = 101, kNadir = 50;
  std::vector<float> sin_beams, amplitude = std::vector<float>(static_cast<std::size_t>(kBeams) * kSamples, 1.0F);
  Settings settings{
      .pulse_length_s = kPulse * kPeriod_s, .receive_length_in_waves = 50.76, .second_echo = {true, kHeadDepth_m}};

  Fan() {
    for (int beam = 0; beam < kBeams; ++beam) sin_beams.push_back(static_cast<float>(std::sin(angle_rad(beam))));
  }
  static double angle_rad(int beam) { return 0.5 * kDeg * (beam - kNadir); }
  /// Each beam receives one return, from this depth below the head.
  explicit Fan(const std::function<double(int beam)>& depth_m) : Fan() {
    for (int beam = 0; beam < kBeams; ++beam) add(beam, depth_m(beam), 100.0F);
  }

  Fan& add(int beam, double depth_m, float pulse_amplitude) {
    const auto first = static_cast<std::size_t>(std::lround(depth_m / std::cos(angle_rad(beam)) / 750.0 / kPeriod_s));
    for (std::size_t k = first; k < first + kPulse && k < kSamples; ++k) {
      amplitude[static_cast<std::size_t>(beam) * kSamples + k] = pulse_amplitude;
    }
    return *this;
  }
  Fan& fade(int beam, float to) { return add(beam, kDepth_m, to); }

  std::vector<Detection> detect() const {
    std::vector<Detection> found;
    detect_bottom(settings, sin_beams, {kBeams, kSamples, 0.0, kPeriod_s, amplitude}, found);
    return found;
  }
  /// Depths below the head, 0 of beams without.
  std::vector<double> depths_m() const {
    std::vector<double> depths;
    const auto found = detect();
    for (int beam = 0; beam < kBeams; ++beam) {
      const Detection& d = found[static_cast<std::size_t>(beam * settings.max_detections)];
      depths.push_back(d.valid ? 750.0 * d.two_way_s * std::cos(angle_rad(beam)) : 0.0);
    }
    return depths;
  }
};

double level(int) { return kDepth_m; }

/// Beams whose detection is not within a sample of the depth that is said to be true.
int beams_off(const Fan& fan, const std::function<double(int)>& depth_m) {
  const auto found = fan.depths_m();
  int off = 0;
  for (int beam = 0; beam < Fan::kBeams; ++beam) {
    off += std::abs(found[static_cast<std::size_t>(beam)] - depth_m(beam)) > 750.0 * kPeriod_s;
  }
  return off;
}

}  // namespace

TEST_CASE("a bottom that has faded below its second echo is found all the same") {
  for (const int run : {1, 2, 4}) {  // beams that overlap fade together
    for (const int first : {0, 20, Fan::kNadir, Fan::kBeams - run}) {
      Fan fan(level);
      for (int beam = first; beam < first + run; ++beam) fan.fade(beam, 30.0F).add(beam, kSecond_m, 60.0F);
      INFO(run << " beams from " << first);
      CHECK(beams_off(fan, level) == 0);
      fan.settings.second_echo.refused = false;
      CHECK(beams_off(fan, level) == run);
      CHECK_THAT(fan.depths_m()[static_cast<std::size_t>(first)], WithinAbs(kSecond_m, 750.0 * kPeriod_s));
    }
  }
}

TEST_CASE("a beam with the second echo alone has no bottom, and is flagged") {
  Fan fan(level);
  fan.fade(Fan::kNadir, 1.0F).add(Fan::kNadir, kSecond_m, 60.0F);
  const Detection nadir = fan.detect()[Fan::kNadir];
  CHECK_FALSE(nadir.valid);
  CHECK(nadir.flags == (kLowSnr | kOutOfGate));
}

TEST_CASE("a second echo that is the weaker is no further detection either") {
  Fan fan(level);
  fan.settings.max_detections = 2;
  fan.add(Fan::kNadir, kSecond_m, 60.0F).add(20, 15.0, 60.0F);
  const auto found = fan.detect();
  CHECK(found[2 * Fan::kNadir].valid);
  CHECK_FALSE(found[2 * Fan::kNadir + 1].valid);
  CHECK(found[2 * 20 + 1].valid);  // what is not so deep stays
  fan.settings.second_echo.refused = false;
  CHECK(fan.detect()[2 * Fan::kNadir + 1].valid);
}

TEST_CASE("steep relief stays: a step to twice the depth, a wall, a slope") {
  const auto step_down = [](int beam) { return beam < Fan::kNadir ? kDepth_m : kSecond_m; };
  const auto step_up = [](int beam) { return beam < Fan::kNadir ? kSecond_m : kDepth_m; };
  const auto at_the_end = [](int beam) { return beam < Fan::kBeams - 11 ? kDepth_m : kSecond_m; };
  const auto wall = [](int beam) { return kDepth_m + std::clamp(beam - Fan::kNadir, 0, 8) * 11.0 / 8.0; };
  const auto slope = [](int beam) { return kDepth_m / (1.0 - std::tan(Fan::angle_rad(beam))); };  // 45 degrees
  for (const std::function<double(int)>& relief :
       std::vector<std::function<double(int)>>{step_down, step_up, at_the_end, wall, slope}) {
    CHECK(beams_off(Fan(relief), relief) == 0);
  }
}

TEST_CASE("a hole stays if it is wider than five beams' widths, or of another depth") {
  const auto hole = [](int width, double depth_m) {
    return [=](int beam) { return beam >= Fan::kNadir && beam < Fan::kNadir + width ? depth_m : kDepth_m; };
  };
  CHECK(beams_off(Fan(hole(11, kSecond_m)), hole(11, kSecond_m)) == 0);
  CHECK(beams_off(Fan(hole(3, 15.0)), hole(3, 15.0)) == 0);
  CHECK(beams_off(Fan(hole(3, kSecond_m * 1.06)), hole(3, kSecond_m * 1.06)) == 0);
  CHECK(beams_off(Fan(hole(3, kSecond_m)), hole(3, kSecond_m)) == 3);  // what is lost, as the header says
}

TEST_CASE("fish at half the depth take no bottom from the beams about them") {
  // Below a school the bottom is the deeper one; where the school is the strongest it was so before.
  const double deep_m = 2.0 * kDepth_m + kHeadDepth_m;
  const auto bottom = [=](int) { return deep_m; };
  Fan school(bottom);
  for (const int beam : {44, 47, 50, 51, 52, 55}) school.add(beam, kDepth_m, 60.0F);
  CHECK(beams_off(school, bottom) == 0);
  for (const int beam : {45, 46, 53}) school.add(beam, kDepth_m, 200.0F);
  CHECK(beams_off(school, bottom) == 3);
}

TEST_CASE("the nadir's echo in the side lobes of the outer beams refuses none of them") {
  // At 60 degrees a level bottom is twice as far as at nadir: were ranges compared, and not depths, it would be
  // refused.
  Fan fan;
  for (int beam = 0; beam < Fan::kBeams; ++beam) {
    fan.sin_beams[static_cast<std::size_t>(beam)] =
        static_cast<float>(std::sin(1.3 * kDeg * (beam - Fan::kNadir)));  // to 65 degrees
  }
  std::fill(fan.amplitude.begin(), fan.amplitude.end(), 1.0F);
  const auto pulse = [&](std::size_t beam, double range_m, float amplitude) {
    const auto first = static_cast<std::size_t>(std::lround(range_m / 750.0 / kPeriod_s));
    for (std::size_t k = first; k < first + kPulse; ++k) fan.amplitude[beam * kSamples + k] = amplitude;
  };
  const auto range_m = [&](std::size_t beam) {
    const double sine = static_cast<double>(fan.sin_beams[beam]);
    return kDepth_m / std::sqrt(1.0 - sine * sine);
  };
  for (std::size_t beam = 0; beam < Fan::kBeams; ++beam) {
    pulse(beam, kDepth_m, 30.0F);
    pulse(beam, range_m(beam), 100.0F);
  }
  fan.settings.second_echo.head_depth_m = 0.0;
  const auto found = fan.detect();
  for (std::size_t beam = 0; beam < Fan::kBeams; ++beam) {
    CHECK(found[beam].valid);
    CHECK(750.0 * found[beam].two_way_s == Approx(range_m(beam)).epsilon(0.02));
  }
}

TEST_CASE("speckle: of the beams about nadir that would take the second echo none does") {
  // 13 dB below the first, at 50 dB over the noise. A beam that receives one pulse of each takes the second with the
  // probability s / (1 + s) = 4.8 %, s = 0.05; farther from nadir than some 5 degrees pulses average. 21 of the 41
  // beams in 40 pings: up to 40, fewer since the second echo lasts twice as long.
  PlaneSurvey plane;
  plane.snr_db = 50.0;
  plane.second_db = -13.0;
  plane.longest_s = 0.07;
  for (int i = -20; i <= 20; ++i) plane.sin_beams.push_back(static_cast<float>(std::sin(0.5 * kDeg * i)));
  Settings refusing = settings_for(plane), taking = refusing;
  refusing.second_echo = {true, 0.0};
  PlaneEcho echo;
  std::vector<Detection> found;
  int deep = 0, deep_when_refused = 0, found_again = 0;
  for (std::uint64_t ping = 0; ping < 40; ++ping) {
    echo.ping(plane, {9, "second"}, ping);
    const auto depth_m = [&](std::size_t beam) {
      return 750.0 * found[beam].two_way_s * std::cos(std::asin(static_cast<double>(plane.sin_beams[beam])));
    };
    detect_bottom(taking, plane.sin_beams, echo.amplitudes(plane), echo.halves(), found);
    std::vector<std::size_t> taken;
    for (std::size_t beam = 0; beam < found.size(); ++beam) {
      if (found[beam].valid && depth_m(beam) > 30.0) taken.push_back(beam);
    }
    deep += static_cast<int>(taken.size());
    detect_bottom(refusing, plane.sin_beams, echo.amplitudes(plane), echo.halves(), found);
    for (std::size_t beam = 0; beam < found.size(); ++beam)
      deep_when_refused += found[beam].valid && depth_m(beam) > 30.0;
    for (const std::size_t beam : taken) found_again += found[beam].valid && std::abs(depth_m(beam) - 20.0) < 0.2;
  }
  INFO(deep << " took the second echo, of 1640; " << found_again << " of them found the bottom when it was refused");
  CHECK(deep > 8);
  CHECK(deep < 60);
  CHECK(deep_when_refused == 0);
  // What has faded by 13 dB and more still stands over the gate of 13 dB, unless by 37 dB: 0.4 % of them.
  CHECK(found_again >= deep - 1);
}
