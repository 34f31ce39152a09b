#include "kernels/acoustics/echo/volume.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/echo/aperture.h"

using namespace ensonify;
using namespace ensonify::echo;
using Catch::WithinAbs;

static const frames::HeadPose kHead{{0, 0, -5}, frames::enu_from_ned()};
static const Pulse kPulse = rectangular_pulse(200e-6);
static VolumeLayers everywhere(double sv_db) {
  return {[sv_db](double) { return std::pow(10, 0.1 * sv_db); }, 500.0};
}

TEST_CASE("the solid angle of a pattern is that of its closed form") {
  const auto ball = VolumeDirections::of([](const Eigen::Vector3f&) { return 1.0; }, {0, 1, 0}, -1, 1, 0.02);
  double sum = 0;
  for (const auto& part : ball.directions) sum += part.solid_angle_sr;
  CHECK(sum == Approx(4 * std::numbers::pi).epsilon(1e-5));
  // A line of 20 waves: 4 pi times the mean of its pattern over sine, lambda / 2 L, less the tails beyond +-1.
  const auto line = VolumeDirections::of([](const Eigen::Vector3f& d) { return array::line_power(20, d.x()); },
                                         {1, 0, 0}, -1, 1, 0.005);
  sum = 0;
  for (const auto& part : line.directions) sum += part.solid_angle_sr;
  CHECK(sum == Approx(4 * std::numbers::pi / 40).epsilon(0.006));
}

TEST_CASE("reverberation has the level of the sonar equation") {
  const auto ball = VolumeDirections::of([](const Eigen::Vector3f&) { return 1.0; }, {0, 1, 0}, -1, 1, 0.05);
  auto layers = everywhere(-70);
  layers.deepest_m = 500;
  const frames::HeadPose deep{{0, 0, -250}, frames::enu_from_ned()};
  std::vector<float> level;
  reverberation_upa2(210, 0.05, 1500, std::span(&ball, 1), layers, deep, kPulse, {0, 100e-6, 1000}, level);
  for (const int k : {100, 400, 999}) {
    const double R = 750 * (k * 100e-6 - 100e-6);  // the middle of the pulse
    const double want =
        210 - 20 * std::log10(R) - 0.1 * R - 70 + 10 * std::log10(4 * std::numbers::pi * 1500 * 200e-6 / 2);
    CHECK_THAT(10 * std::log10(level[k]), WithinAbs(want, 0.01));
  }
  CHECK(level[0] == 0.0F);
}

TEST_CASE("a layer answers from its depth, in every beam at its own time") {
  // A pencil beam 45 deg down; a layer between 15 and 17 m, the head at 5 m: slant ranges 14.1 to 17.0 m.
  const double c = std::sqrt(0.5);
  const auto pencil = VolumeDirections::of(
      [&](const Eigen::Vector3f& d) { return d.dot(Eigen::Vector3f(0, float(c), float(c))) > 0.9998F ? 1.0 : 0.0; },
      {1, 0, 0}, -0.05, 0.05, 0.002);
  VolumeLayers layer{[](double z) { return z > 15 && z < 17 ? 1e-6 : 0.0; }, 100, 0.1};
  std::vector<float> level;
  reverberation_upa2(200, 0, 1500, std::span(&pencil, 1), layer, kHead, kPulse, {0, 100e-6, 600}, level);
  int begin = 0, end = 599;
  while (level[begin] == 0.0F) ++begin;
  while (level[end] == 0.0F) --end;
  CHECK_THAT(750 * (begin - 1) * 100e-6, WithinAbs(10 / c, 0.45));  // the pencil is 2.3 deg wide: 0.3 m; steps 0.075
  CHECK_THAT(750 * (end - 1) * 100e-6, WithinAbs(12 / c, 0.45));
}

TEST_CASE("a seabed above the surface leaves no water to scatter") {
  const auto ball = VolumeDirections::of([](const Eigen::Vector3f&) { return 1.0; }, {0, 1, 0}, -1, 1, 0.05);
  auto layers = everywhere(-70);
  std::vector<float> level;
  for (const double deepest_m : {0.0, -3.0}) {
    layers.deepest_m = deepest_m;
    reverberation_upa2(210, 0.05, 1500, std::span(&ball, 1), layers, kHead, kPulse, {0, 100e-6, 200}, level);
    CHECK(*std::max_element(level.begin(), level.end()) == 0.0F);
  }
}

TEST_CASE("beams of a line array receive it with their own patterns, and neighbours alike") {
  // Isotropic transmission: a beam's Psi is 4 pi lambda / 2 L. Beams a null apart are independent, half a null apart
  // correlated by 2 / pi. The pulse colours time: samples within it are alike, beyond are not.
  const int M = 32;
  LineReceiver receiver({M, 0.5});
  const auto cells = directions_of_cells(
      receiver, [](const Eigen::Vector3f&) { return 1.0; }, 0.05);
  const Sampling sampling{0.2, 100e-6, 12000};
  std::vector<float> level;
  const frames::HeadPose deep{{0, 0, -2000}, frames::enu_from_ned()};
  auto layers = everywhere(-70);
  layers.deepest_m = 4000;
  layers.step_m = 5;
  reverberation_upa2(210, 0.0, 1500, cells, layers, deep, kPulse, sampling, level);
  // Level it, so that all samples have one mean square.
  for (int k = 0; k < sampling.count; ++k) {
    const double R = 750 * (0.2 + k * 100e-6 - 100e-6);
    for (int c = 0; c < receiver.cells(); ++c)
      level[std::size_t(k) * std::size_t(receiver.cells()) + std::size_t(c)] *= float(R * R);
  }
  const random::Stream stream{1, "volume"};
  const std::vector<float> beams{0.2F, 0.2F + 1.0F / 32, 0.2F + 2.0F / 32};
  const std::vector<WantedImage> wanted{WantedImage(beam_weights(std::vector<double>(M, 1.0)))};
  std::vector<Image> images(1);
  LineReceiver::Memory memory;
  receiver.form({{}, SampledPulse(kPulse, 100e-6), sampling, {1, 0, nullptr, 0, nullptr, level, &stream}}, beams,
                wanted, images, memory);
  double power = 0, null = 0, next = 0, later = 0;
  std::complex<double> half_null;
  for (int k = 2; k < sampling.count; ++k) {
    const auto p = images[0].row(0)[k];
    power += std::norm(p);
    half_null += std::complex<double>(p * std::conj(images[0].row(1)[k]));
    null += std::real(p * std::conj(images[0].row(2)[k]));
    next += std::real(p * std::conj(images[0].row(0)[k - 1]));
    later += std::real(p * std::conj(images[0].row(0)[k - 2]));
  }
  const double want = std::pow(10, 0.1 * (210 - 70)) * 4 * std::numbers::pi / M * 0.5 * 1500 * 200e-6;
  CHECK(power / sampling.count == Approx(want).epsilon(0.06));  // 6,000 independent pulses: sd 1.3 %
  CHECK(std::abs(null / power) < 0.06);
  CHECK(std::abs(later / power) < 0.06);
  CHECK_THAT(next / power, WithinAbs(0.5, 0.05));
  CHECK_THAT(std::abs(half_null) / power, WithinAbs(2 / std::numbers::pi, 0.05));
}

TEST_CASE("rows of single apertures have the level they are given") {
  Image image;
  image.resize(2, 20000);
  std::vector<float> level(40000);
  for (std::size_t i = 0; i < level.size(); ++i) level[i] = i % 2 == 0 ? 4.0F : 9.0F;
  RowBackground background;
  background.add_reverberation(level, SampledPulse(kPulse, 50e-6), 3, {1, "volume"}, image);
  for (int row = 0; row < 2; ++row) {
    double power = 0, next = 0;
    for (int k = 1; k < 20000; ++k) {
      power += std::norm(image.row(row)[k]);
      next += std::real(image.row(row)[k] * std::conj(image.row(row)[k - 1]));
    }
    CHECK(power / 20000 == Approx(row == 0 ? 4 : 9).epsilon(0.08));  // 5,000 pulses: sd 1.4 %, coloured a little more
    CHECK_THAT(next / power, WithinAbs(0.75, 0.05));                 // four samples in a pulse
  }
}
