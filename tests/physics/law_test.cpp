#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/echo/aperture.h"
#include "kernels/base/random/stream.h"
#include "kernels/seabed/backscatter.h"
#include "tests/physics/area_integral.h"
#include "tests/physics/mills_cross.h"

// Reciprocity and energy, at random.

using namespace ensonify;
using namespace ensonify::physics;
using Catch::WithinAbs;
using frames::Vec3;

namespace {

constexpr double kPi = std::numbers::pi;

Vec3 somewhere(const random::Stream& stream, std::uint64_t number, std::uint64_t what, double within_m) {
  return within_m * Vec3(2 * stream.uniform(number, what, 0) - 1, 2 * stream.uniform(number, what, 1) - 1,
                         2 * stream.uniform(number, what, 2) - 1);
}

/// An end of a path: a line array, and how it is turned.
struct End {
  frames::HeadPose pose;
  double waves;

  double power(const Vec3& place_enu_m) const {
    return array::line_power(waves, frames::head_from_enu(pose, place_enu_m).normalized().x());
  }
};

/// Sound from one end by a point of unit cross section to the other.
struct Echo {
  double time_s, level_db;
};
Echo echo_of(const End& source, const Vec3& point_enu_m, const End& receiver) {
  const double out_m = (point_enu_m - source.pose.position_enu_m).norm();
  echo::Scatterer point;
  point.position_enu_m = point_enu_m;
  point.slowness_spm = static_cast<float>(1.0 / kSpeed_mps);
  point.scattered_upa2m2 = static_cast<float>(1e20 * source.power(point_enu_m) / (out_m * out_m));
  echo::Receivers receivers;
  receivers.set({0.0, 1.0, std::span(&receiver.pose, 1)});
  echo::Arrivals arrivals;
  echo::add_direct_echoes({300e3, 0.07, echo::Sum::kMeanSquare}, source.pose.position_enu_m, {point}, receivers,
                          arrivals);
  const double received = array::line_power(receiver.waves, double(arrivals[0].direction_head.x()));
  return {arrivals[0].time_s, db(double(arrivals[0].pressure_upa.real()) * received)};
}

}  // namespace

TEST_CASE("reciprocity: source and receiver change places, and nothing changes") {
  // Two stations with lines of different lengths anyhow turned. Refracted paths: kernels/water/refraction, "there and
  // back".
  const random::Stream draw{1, "reciprocity"};
  for (std::uint64_t i = 0; i < 300; ++i) {
    const auto station = [&](std::uint64_t which) {
      return End{
          {somewhere(draw, i, which, 30.0), frames::enu_from_body({.heading_rad = 6.28 * draw.uniform(i, which, 3),
                                                                   .pitch_rad = 3.0 * draw.uniform(i, which, 4) - 1.5,
                                                                   .roll_rad = 6.28 * draw.uniform(i, which, 5)})},
          0.5 + 20.0 * draw.uniform(i, which, 6)};
    };
    const End a = station(1), b = station(2);
    const Vec3 point = somewhere(draw, i, 3, 40.0);
    const Echo there = echo_of(a, point, b), back = echo_of(b, point, a);
    REQUIRE(there.time_s == Approx(back.time_s).epsilon(1e-7));  // slowness is a float
    // Direction cosines are floats: beside a null, 60 dB down, that is 0.02 dB.
    if (there.level_db > 10.0) REQUIRE_THAT(there.level_db, WithinAbs(back.level_db, 0.02));
  }
}

TEST_CASE("a Lambert bowl about the head returns the energy that falls on it, evenly") {
  // A cap of a sphere of radius R about the head, 50 degrees to either side, hit at right angles. Of the power
  // p0^2 b_T dOmega in a direction, a perfect diffuser (mu = 1 / pi) returns b_T dOmega / (pi R^2), from everywhere at
  // the same time: p^2 = p0^2 / (pi R^2) Integral b_T b_R dOmega, never more than twice p0^2 / R^2.
  constexpr double kRadius_m = 20.0, kCap_rad = 50 * kPi / 180;
  const MillsCross cross{
      .elements = 8, .spacing_in_waves = 0.5, .range_m = 30.0, .half_swath_rad = kCap_rad, .quality = 4.0};
  const trace::Scene bowl = scene_of(36.0, 0.1, [](double east, double north) {
    const double r = std::hypot(east, north);
    return r < kRadius_m * std::sin(kCap_rad) ? -std::sqrt(kRadius_m * kRadius_m - r * r) : std::nan("");
  });
  const auto diffuser = [](double grazing_rad) { return std::pow(std::sin(grazing_rad), 2) / kPi; };
  const std::vector<float> nadir{0.0F};
  const echo::Image image = cross.receive(bowl, {}, diffuser, nadir);
  double energy = 0.0;
  for (const auto& p2 : image.row(0)) energy += double(p2.real());
  energy *= cross.sample_period_s;

  double received_sr = 0.0;  // over the cap, in polar coordinates about the axis
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i) {
    const double off_axis = (i + 0.5) * kCap_rad / kSteps;
    for (int j = 0; j < kSteps; ++j) {
      const double around = (j + 0.5) * 2 * kPi / kSteps, level = std::sin(off_axis);
      received_sr += cross.two_way_power(level * std::cos(around), level * std::sin(around), 0.0) * level * kCap_rad /
                     kSteps * 2 * kPi / kSteps;
    }
  }
  const double expected = std::pow(10.0, 0.1 * cross.source_level_db) * received_sr / (kPi * kRadius_m * kRadius_m);
  CHECK_THAT(db(energy / cross.pulse_length_s / expected), WithinAbs(0.0, 0.1));
}
