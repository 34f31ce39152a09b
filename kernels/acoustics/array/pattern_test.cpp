#include "kernels/acoustics/array/pattern.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace ensonify::array;
using Catch::WithinAbs;
using Eigen::Vector3f;

static constexpr double kWaves = 20.0;

static std::shared_ptr<const PatternTable> line_table() {
  return std::make_shared<PatternTable>([](double sine) { return line_amplitude(kWaves, sine); }, 0.5 * kWaves);
}

static Vector3f direction(double sine, double around_rad) {
  const double beside = std::sqrt(1.0 - sine * sine);
  return Eigen::Vector3d(sine, beside * std::sin(around_rad), beside * std::cos(around_rad)).cast<float>();
}

/// Directions all around, with ranges, and one of each factor that has one.
namespace {
struct Many {
  std::vector<float> x, y, z, range_m;

  explicit Many(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const double share = (double(i) + 0.5) / double(count);
      const Vector3f one = direction(2.0 * share - 1.0, 100.0 * share);
      x.push_back(one.x()), y.push_back(one.y()), z.push_back(one.z());
      range_m.push_back(float(1.0 + 50.0 * share));
    }
  }
  Directions directions() const { return {x, y, z}; }
};
}  // namespace

static Pattern of_all_factors() {
  const auto table = line_table();
  return Pattern()
      .times(LineFactor{.table = table, .axis_head = Vector3f::UnitY(), .sin_steer = 0.01})
      .times(PistonFactor{table})
      .times(NearFieldFactor{1.0, 0.05, NearFieldFactor::Focus::kFixed, 20.0})
      .times(GaussianFactor{0.3})
      .times_power(CosineFactor{0.7F})
      .times_power(FaceFactor{.face = Face(1.0, 20.0)})
      .times_power(EdgeFactor{table, 0.2, false});
}

TEST_CASE("a pattern gives an array of directions what it gives each of them") {
  const Many many(1000);  // several runs, the last one short
  const Pattern pattern = of_all_factors();
  std::vector<float> amplitude(1000);
  std::vector<double> power(1000);
  pattern.amplitudes(many.directions(), many.range_m, amplitude);
  pattern.powers(many.directions(), many.range_m, power);
  double largest = 0.0;
  for (std::size_t i = 0; i < 1000; ++i) {
    REQUIRE(amplitude[i] == pattern.amplitude(many.directions()[i], many.range_m[i]));
    REQUIRE(power[i] == pattern.power(many.directions()[i], many.range_m[i]));
    REQUIRE_THAT(power[i], WithinAbs(double(amplitude[i]) * double(amplitude[i]), 1e-6));
    largest = std::max(largest, power[i]);
  }
  CHECK(largest > 0.01);
}

TEST_CASE("a pattern without factors is 1, and without ranges it is that of the far field") {
  const Many many(300);
  std::vector<float> amplitude(300);
  Pattern().amplitudes(many.directions(), {}, amplitude);
  CHECK(std::ranges::count(amplitude, 1.0F) == 300);
  const Pattern near = Pattern().times(NearFieldFactor{1.0, 0.05, NearFieldFactor::Focus::kOff});
  near.amplitudes(many.directions(), {}, amplitude);
  for (std::size_t i = 0; i < 300; ++i) {
    const auto far = float(std::abs(line_amplitude(kWaves, double(many.x[i]))));
    REQUIRE_THAT(double(amplitude[i]), WithinAbs(double(far), 1e-5));
  }
}

TEST_CASE("a steered line has its axis where it is steered, and nothing beyond its end") {
  const Pattern line = Pattern().times(LineFactor{.table = line_table(), .sin_steer = 0.1, .end = 0.05F});
  CHECK_THAT(line.amplitude(direction(0.1, 0.0)), WithinAbs(1.0, 1e-4));
  CHECK(line.amplitude(direction(0.149, 0.0)) != 0.0F);
  CHECK(line.amplitude(direction(0.151, 0.0)) == 0.0F);
  CHECK(line.amplitude(direction(0.049, 0.0)) == 0.0F);
}

TEST_CASE("a sector's edge halves the amplitude where it stands, and copies of a pattern steer apart") {
  const auto edge_at = [](double sine, bool inside_above) {
    const auto table = std::make_shared<PatternTable>(
        [](double u) { return 0.5 + 0.5 * std::sin(0.5 * std::numbers::pi * std::clamp(u / 0.1, -1.0, 1.0)); }, 30.0);
    return Pattern().times_power(EdgeFactor{table, sine, inside_above});
  };
  const auto towards = [](double y) { return Vector3f(0.0F, float(y), float(std::sqrt(1.0 - y * y))); };
  const Pattern above = edge_at(0.3, true), below = edge_at(0.3, false);
  CHECK_THAT(above.amplitude(towards(0.3)), WithinAbs(0.5, 1e-4));
  CHECK(above.amplitude(towards(0.41)) == 1.0F);
  CHECK(above.amplitude(towards(0.19)) == 0.0F);
  CHECK(below.amplitude(towards(0.41)) == 0.0F);
  CHECK(below.amplitude(towards(0.19)) == 1.0F);
  Pattern other = above;
  other.times(FaceFactor{{0.0F, 0.0F, -1.0F}, Face(0.0, 20.0)});
  CHECK_THAT(other.amplitude(towards(0.5)), WithinAbs(0.1, 1e-6));
  CHECK(above.amplitude(towards(0.5)) == 1.0F);
  other.clear();
  CHECK(other.amplitude(towards(0.19)) == 1.0F);
}

TEST_CASE("a Gaussian has half the power at its half width and nothing behind") {
  const double half = 0.05;
  const Pattern beam = Pattern().times(GaussianFactor{0.5 * std::log(2.0) / (half * half)});
  CHECK_THAT(beam.power(direction(half, 0.0)), WithinAbs(0.5, 1e-5));
  CHECK(beam.power({0.0F, 0.0F, -1.0F}) == 0.0);
}

TEST_CASE("powers of patterns that send at once add up") {
  const Many many(300);
  const std::vector<Pattern> sides{Pattern().times(FaceFactor{Vector3f::UnitY(), Face(0.0, 20.0)}),
                                   Pattern().times(FaceFactor{-Vector3f::UnitY(), Face(0.0, 20.0)})};
  std::vector<double> power(300);
  powers(sides, many.directions(), {}, power);
  for (std::size_t i = 0; i < 300; ++i) {
    REQUIRE_THAT(power[i], WithinAbs(1.01, 1e-6));
    REQUIRE(power[i] == ensonify::array::power(sides, many.directions()[i]));
  }
  powers({}, many.directions(), {}, power);
  CHECK(std::ranges::count(power, 0.0) == 300);  // nobody sends
}

TEST_CASE("a pattern refuses arrays of other lengths") {
  const Many many(10);
  std::vector<float> amplitude(9), range_m(9, 1.0F);
  std::vector<double> power(10);
  CHECK_THROWS_AS(Pattern().amplitudes(many.directions(), {}, amplitude), std::invalid_argument);
  CHECK_THROWS_AS(Pattern().powers(many.directions(), range_m, power), std::invalid_argument);
  CHECK_THROWS_AS(powers({}, many.directions(), range_m, power), std::invalid_argument);
}

TEST_CASE("powers of a cosine are right to (1.5 + power) 1e-7 of the axis") {
  for (const float power : {0.0F, 0.5F, 2.0F, 20.0F}) {
    const Pattern pattern = Pattern().times_power(CosineFactor{power});
    double worst = 0.0;
    for (int i = -2000; i <= 2000; ++i) {
      const float y = 5e-4F * static_cast<float>(i), across = std::sqrt(std::max(0.0F, (1.0F - y) * (1.0F + y)));
      const double want = std::pow((1.0 - double(y)) * (1.0 + double(y)), double(power));
      worst = std::max(worst, std::abs(pattern.power({0.0F, y, across}) - want));
    }
    CHECK(worst < 1.5e-7 + 1e-7 * double(power));  // that of the polynomials, and of 1 - y^2 as a float
  }
}
