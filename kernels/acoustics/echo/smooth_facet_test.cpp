#include "kernels/acoustics/echo/smooth_facet.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/base/random/stream.h"
#include "kernels/mesh/solids/solid.h"

using namespace ensonify;
using namespace ensonify::echo;
using Catch::Matchers::WithinAbs;
using frames::Vec3;
using solids::Corners;
using solids::Facet;
using solids::split_facet;
using Complex = std::complex<double>;

namespace {

constexpr double kSpeed_mps = 1500.0;
double wavelength_m(double frequency_hz) { return kSpeed_mps / frequency_hz; }
double wavenumber(double frequency_hz) { return 2.0 * std::numbers::pi / wavelength_m(frequency_hz); }

/// Target strength as a head at that place has it: each facet with its own way there and back; a body that hides
/// nothing of what faces the head.
double target_strength_db(const solids::Surface& surface, const Vec3& head_m, double frequency_hz,
                          bool two_sided = false) {
  const double k = wavenumber(frequency_hz), range_m = head_m.norm();
  Complex sum = 0.0;
  for (std::size_t t = 0; t < surface.mesh.triangle.size(); ++t) {
    split_facet(facet_of(surface, t), longest_side_m(wavelength_m(frequency_hz), range_m), [&](const Facet& facet) {
      const Vec3 way = head_m - (facet.corners[0] + facet.corners[1] + facet.corners[2]) / 3.0;
      const double r = way.norm();
      sum += facet_amplitude_m(facet, way / r, k, two_sided) * std::polar(range_m * range_m / (r * r), -2.0 * k * r);
    });
  }
  return 20.0 * std::log10(std::abs(sum));
}

Vec3 direction(double from_y_rad) { return {std::sin(from_y_rad), std::cos(from_y_rad), 0.0}; }

/// Sum over a fine grid of points of the triangle.
Complex by_points(const Corners& t, const Vec3& per_m) {
  constexpr int kSteps = 400;
  const Vec3 middle = (t[0] + t[1] + t[2]) / 3.0;
  Complex sum = 0.0;
  int count = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; i + j < kSteps; ++j) {
      for (const double third : {1.0 / 3.0, 2.0 / 3.0}) {
        if (third > 0.5 && i + j + 1 >= kSteps) continue;
        const Vec3 x = t[0] + (i + third) / kSteps * (t[1] - t[0]) + (j + third) / kSteps * (t[2] - t[0]);
        sum += std::polar(1.0, per_m.dot(x - middle));
        ++count;
      }
    }
  }
  return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm() * sum / static_cast<double>(count);
}

}  // namespace

TEST_CASE("the phase integral of a triangle is that of its points") {
  const Corners t{Vec3(0.01, 0.0, 0.02), Vec3(0.05, 0.02, 0.0), Vec3(0.0, 0.04, 0.01)};
  const double area_m2 = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
  for (const double scale : {0.0, 1.0, 2.4, 2.6, 60.0, 400.0}) {
    for (const Vec3& along :
         {Vec3(1, 0.2, -0.3), Vec3(0.3, -1, 0.1), Vec3(t[1] - t[0]), Vec3((t[1] - t[0]).cross(t[2] - t[0]))}) {
      const Vec3 per_m = scale * along.normalized();
      CHECK(std::abs(phase_integral_m2(t, per_m) - by_points(t, per_m)) < 2e-5 * area_m2);  // of 160,000 points
    }
  }
}

TEST_CASE("parts of a triangle have its phase integral") {
  const Corners t{Vec3(0, 0, 0), Vec3(2.0, 0.01, 0.0), Vec3(1.3, 0.03, 0.02)};  // a long one
  const Vec3 per_m(-3.0, 900.0, 200.0), middle = (t[0] + t[1] + t[2]) / 3.0;
  Complex sum = 0.0;
  int parts = 0;
  split_facet(Facet{t}, 0.1, [&](const Facet& of) {
    const Corners& part = of.corners;
    for (std::size_t c = 0; c < 3; ++c) CHECK((part[(c + 1) % 3] - part[c]).norm() <= 0.1);
    sum += phase_integral_m2(part, per_m) * std::polar(1.0, per_m.dot((part[0] + part[1] + part[2]) / 3.0 - middle));
    ++parts;
  });
  CHECK(std::abs(sum - phase_integral_m2(t, per_m)) < 1e-12);
  CHECK(parts < 100);
}

TEST_CASE("a rigid sphere of 0.15 m has -22.5 dB from all sides at 300 kHz") {
  const auto surface = solids::surface_of(solids::Sphere{0.3}, kSagittaInWaves * wavelength_m(300e3));
  const random::Stream draws(3, "directions");
  double lowest_db = 0.0, highest_db = -100.0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const double z = 2.0 * draws.uniform(i, 0, 0) - 1.0, turn = 2.0 * std::numbers::pi * draws.uniform(i, 1, 0);
    const Vec3 from = 60.0 * Vec3(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z);
    const double db = target_strength_db(surface, from, 300e3);
    lowest_db = std::min(lowest_db, db), highest_db = std::max(highest_db, db);
  }
  CHECK(lowest_db > -22.5 - 0.15);  // 20 log10(a / 2); what 36 flat parts a facet leave is 0.1 dB
  CHECK(highest_db < -22.5 + 0.15);
}

TEST_CASE("a plate of 0.2 m met square has +18.1 dB, and the lobe of its width") {
  const auto surface = solids::surface_of(solids::Plate{{0.2, 0.2}}, 1e-3);
  const double range_m = 400.0, wave_m = wavelength_m(300e3);  // far beyond L^2 / lambda = 8 m
  const auto ts = [&](double turn_rad) {
    return target_strength_db(surface, range_m * Vec3(std::sin(turn_rad), 0.0, std::cos(turn_rad)), 300e3, true);
  };
  const double peak_db = 20.0 * std::log10(0.04 / wave_m);
  CHECK_THAT(ts(0.0), WithinAbs(peak_db, 0.05));
  CHECK_THAT(ts(std::numbers::pi), WithinAbs(peak_db, 0.05));  // its other side
  // |sinc(2 L sin(turn) / lambda)| cos(turn)
  for (const double turn_rad : {1e-3, 2e-3, 4e-3, 5.5e-3, 17.88e-3}) {
    const double x = 2.0 * std::numbers::pi * 0.2 / wave_m * std::sin(turn_rad);
    CHECK_THAT(ts(turn_rad), WithinAbs(peak_db + 20.0 * std::log10(std::abs(std::sin(x) / x)), 0.1));
  }
  double half_rad = 0.0;
  while (ts(half_rad) > peak_db - 3.0103) half_rad += 1e-5;
  CHECK_THAT(2.0 * half_rad * 180.0 / std::numbers::pi, WithinAbs(0.63, 0.03));
}

TEST_CASE("a cylinder of 0.2 m by 0.1 m has -7.0 dB broadside at 300 kHz") {
  const auto surface = solids::surface_of(solids::Cylinder{0.1, 0.2}, kSagittaInWaves * wavelength_m(300e3));
  const double far_db = 10.0 * std::log10(0.05 * 0.2 * 0.2 / (2.0 * wavelength_m(300e3)));  // a L^2 / (2 lambda)
  CHECK_THAT(far_db, WithinAbs(-7.0, 0.05));
  double worst_db = 0.0;
  for (int i = 0; i < 40; ++i) {  // round the axis
    const double turn = 0.157 * i;
    const double db = target_strength_db(surface, 200.0 * Vec3(std::cos(turn), 0.0, std::sin(turn)), 300e3);
    worst_db = std::max(worst_db, std::abs(db - far_db));
  }
  CHECK(worst_db < 0.15);
  // In turning: the line's own lobe.
  const auto turned = [&](double turn_rad) {
    return target_strength_db(surface, 200.0 * direction(0.5 * std::numbers::pi - turn_rad), 300e3);
  };
  const double x = 2.0 * std::numbers::pi * 0.2 / wavelength_m(300e3) * std::sin(5e-3);
  CHECK_THAT(turned(5e-3) - turned(0.0), WithinAbs(20.0 * std::log10(std::abs(std::sin(x) / x)), 0.2));
}

TEST_CASE("a long cylinder near by has the level of its curved wavefront") {
  // 2 m long, 0.25 m in radius, 50 m off at 900 kHz: the far field begins at 4.8 km. +4.9 dB, where the far field's
  // formula says 24.8.
  const auto surface = solids::surface_of(solids::Cylinder{0.5, 2.0}, kSagittaInWaves * wavelength_m(900e3));
  const Vec3 head = 50.25 * direction(0.5 * std::numbers::pi);
  CHECK_THAT(target_strength_db(surface, head, 900e3), WithinAbs(4.9, 1.0));
}

TEST_CASE("a facet that faces away sends nothing, unless it has two sides") {
  const Facet facet{{Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(0, 0.1, 0)}};
  CHECK(std::abs(facet_amplitude_m(facet, {0, 0, 1}, 1000.0)) > 0.5);
  CHECK(std::abs(facet_amplitude_m(facet, {0, 0, -1}, 1000.0)) == 0.0);
  CHECK(std::abs(facet_amplitude_m(facet, {0, 0, -1}, 1000.0, true)) ==
        Approx(std::abs(facet_amplitude_m(facet, {0, 0, 1}, 1000.0))));
}
