// What a flat seabed appears as to an instrument that computes its soundings with wrong speeds, against closed forms.
#include <catch2/catch.hpp>
#include <numbers>

#include "kernels/water/refraction/eigenray.h"
#include "kernels/water/refraction/thermocline.h"

using namespace ensonify::refraction;
using Catch::Matchers::WithinAbs;
constexpr double kDeg = std::numbers::pi / 180;

/// Time down to a flat seabed at `depth_m` below a face at depth 0, for a beam at an angle from the vertical, to either
/// side.
static double one_way_s(const SoundSpeedProfile& truth, double beam_rad, double depth_m) {
  return path_to_depth(truth, 0, std::numbers::pi / 2 - std::abs(beam_rad), depth_m)->travel_time_s;
}
static PathEnd sounding(const SoundSpeedProfile& applied, double beam_rad, double time_s) {
  return path_at_time(applied, 0, std::numbers::pi / 2 - std::abs(beam_rad), time_s);
}
/// The water of a profile under a face where the speed is another one.
static SoundSpeedProfile with_face(const SoundSpeedProfile& water, double face_mps) {
  std::vector<Knot> knots{{0, face_mps}, {1e-4, water.speed_mps(1e-4)}};
  for (const Knot& knot : water.knots())
    if (knot.depth_m > 1e-4) knots.push_back(knot);
  return SoundSpeedProfile(knots);
}

TEST_CASE("a gradient that the instrument does not know bends a flat seabed as theory says") {
  // Speed c0 + g z, applied c0: to first order in g H / c0 the depth is wrong by g H^2 / (2 c0) (tan^2 b - 1) and the
  // distance across by -g H^2 / c0 tan b (series of PHYSICS's integrals for time and distance). Second order is below
  // 2 (g H / c0) tan^2 b = 2 % here.
  const double c0 = 1500, H = 50;
  for (const double g : {-0.05, 0.05}) {  // frown, smile
    const SoundSpeedProfile truth({{0, c0}, {60, c0 + 60 * g}}), applied = SoundSpeedProfile::uniform(c0);
    for (double degrees = 0; degrees <= 66; degrees += 6) {
      const double b = degrees * kDeg, tan2 = std::tan(b) * std::tan(b), unit = g * H * H / (2 * c0);
      const PathEnd seen = sounding(applied, b, one_way_s(truth, b, H));
      const double across = path_to_depth(truth, 0, std::numbers::pi / 2 - b, H)->horizontal_m;
      // 5 % of the error, or of its size on the vertical near 45 degrees, where it vanishes
      CHECK(seen.depth_m - H == Approx(unit * (tan2 - 1)).epsilon(0.05).margin(0.05 * std::abs(unit)));
      CHECK(seen.horizontal_m - across == Approx(-2 * unit * std::tan(b)).epsilon(0.05).margin(1e-9));
    }
  }
}

TEST_CASE("the right profile flattens the seabed again") {
  const auto water = summer_thermocline();
  for (double degrees = 0; degrees <= 75; degrees += 5) {
    CHECK_THAT(sounding(water, degrees * kDeg, one_way_s(water, degrees * kDeg, 80)).depth_m, WithinAbs(80, 1e-8));
  }
}

TEST_CASE("a straight ray at the head's speed is metres wrong in a thermocline") {
  const auto water = summer_thermocline();
  const PathEnd seen = sounding(SoundSpeedProfile::uniform(1522), 75 * kDeg, one_way_s(water, 75 * kDeg, 80));
  CHECK(std::abs(seen.depth_m - 80) > 5);  // PHYSICS section 5 has 10.6 m for its own sample
}

TEST_CASE("a wrong speed at the face of a level flat array leaves the soundings right") {
  // Snell's invariant: the array steers by sin(beam) / used speed, and the trace starts with the same number.
  const auto water = summer_thermocline();
  for (const double error : {-10.0, 10.0}) {
    const double used = 1522 + error;
    for (double degrees = -72; degrees <= 72; degrees += 8) {
      const double commanded = degrees * kDeg, really = std::asin(std::sin(commanded) * 1522 / used);
      const PathEnd seen = sounding(with_face(water, used), commanded, one_way_s(water, really, 80));
      CHECK_THAT(seen.depth_m, WithinAbs(80, 5e-3));
    }
  }
}

TEST_CASE("tilted or with a cast, a wrong face speed tilts beams as theory predicts") {
  // With e = used / true - 1, a beam at angle a from the array's normal on an array rolled by r really points to
  // b = a + r with a smaller by e tan a. Traced from the wrong speed the angle is wrong by e (tan a - tan b), from the
  // cast by e tan a; the depth by -x times that. e = 1/1500, so second order is below 1 %.
  const double c = 1500, used = 1501, e = 1 / c, H = 50;
  const auto water = SoundSpeedProfile::uniform(c);
  for (const double roll : {-15 * kDeg, 15 * kDeg}) {
    for (double degrees = 10; degrees <= 60; degrees += 10) {
      const double commanded = degrees * kDeg, a = std::asin(std::sin(commanded) * c / used), b = a + roll;
      const double time = one_way_s(water, b, H), across = H * std::tan(b);
      const PathEnd from_face = sounding(with_face(water, used), commanded + roll, time);
      const PathEnd from_cast = sounding(water, commanded + roll, time);
      const double tilt = e * (std::tan(a) - std::tan(b));
      CHECK(from_face.depth_m - H == Approx(-across * tilt).epsilon(0.05).margin(2e-5));
      CHECK(from_cast.depth_m - H == Approx(-across * e * std::tan(a)).epsilon(0.05).margin(2e-5));
    }
  }
}
