#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/seabed/material.h"
#include "kernels/seabed/sediment.h"
#include "tests/physics/area_integral.h"
#include "tests/physics/mills_cross.h"

// What is arbitrary in a simulation must not show: rays, mesh, sample rate, the terrain's axes. And what a mesh is made
// of: a sphere of facets.

using namespace ensonify;
using namespace ensonify::physics;
using Catch::WithinAbs;

namespace {

constexpr double kDeg = std::numbers::pi / 180.0;
const std::vector<double> kBeams_deg{-70, -60, -45, -30, -15, 0, 15, 30, 45, 60, 70};

/// A slope of 5 degrees that a swell of 0.3 m and 12 m runs over, in a frame turned clockwise by `turn_rad`.
trace::Scene rolling(double spacing_m, double turn_rad = 0.0) {
  return scene_of(256.0, spacing_m, [=](double east, double north) {
    const double x = east * std::cos(turn_rad) - north * std::sin(turn_rad);
    const double y = east * std::sin(turn_rad) + north * std::cos(turn_rad);
    return -20.0 + std::tan(5 * kDeg) * x + 0.3 * std::sin(2 * std::numbers::pi * (0.9 * x + 0.43 * y) / 12.0);
  });
}

seabed::Law medium_sand() { return seabed::law_of(*seabed::sediment_of("medium sand"), 300e3, kSpeed_mps); }

/// Energy of the echo in a beam, uPa^2 s.
double energy_upa2s(const MillsCross& cross, const echo::Image& image, int beam) {
  double sum = 0.0;
  for (const auto& p2 : image.row(beam)) sum += static_cast<double>(p2.real());
  return sum * cross.sample_period_s;
}

/// Of each beam, dB, of a head that is turned with the terrain, a quarter of a metre beside the axis of the turn.
std::vector<double> levels_db(const MillsCross& cross, const trace::Scene& seabed, double turn_rad = 0.0) {
  std::vector<float> sines;
  for (const double deg : kBeams_deg) sines.push_back(static_cast<float>(std::sin(deg * kDeg)));
  const frames::HeadPose head{Eigen::AngleAxisd(-turn_rad, frames::Vec3::UnitZ()) * frames::Vec3(0.13, 0.21, 0.0),
                              frames::enu_from_body({.heading_rad = turn_rad})};
  const echo::Image image = cross.receive(seabed, head, medium_sand(), sines);
  std::vector<double> levels;
  for (int b = 0; b < image.beams; ++b) levels.push_back(db(energy_upa2s(cross, image, b)));
  return levels;
}

void check_equal(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    INFO(kBeams_deg[i] << " deg: " << a[i] << " and " << b[i] << " dB");
    CHECK_THAT(a[i], WithinAbs(b[i], 0.2));
  }
}

}  // namespace

// Sums of mean squares over the echo of a beam: some 10 pulses of 12 rays and more leave 3 %, 0.1 dB, at quality 1.
TEST_CASE("four times the rays, the same level") {
  const trace::Scene seabed = rolling(0.5);
  check_equal(levels_db({.quality = 1.0}, seabed), levels_db({.quality = 4.0}, seabed));
}

TEST_CASE("four times the facets, the same level") {
  // The swell is 24 posts long at 0.5 m: facets cut 0.3 m x (pi / 24)^2 / 2 = 3 mm off its crests.
  check_equal(levels_db({.quality = 2.0}, rolling(0.5)), levels_db({.quality = 2.0}, rolling(0.25)));
}

TEST_CASE("twice the sample rate, the same level") {
  const trace::Scene seabed = rolling(0.5);
  check_equal(levels_db({.sample_period_s = 50e-6}, seabed), levels_db({.sample_period_s = 25e-6}, seabed));
}

TEST_CASE("terrain turned together with the head, the same level") {
  // Other facets, other cells of scatterers, other rays: the mesh's axes leave no trace.
  const double turn_rad = 37 * kDeg;
  const MillsCross cross{.quality = 2.0};
  check_equal(levels_db(cross, rolling(0.25)), levels_db(cross, rolling(0.25, turn_rad), turn_rad));
}

TEST_CASE("a rigid sphere of facets has the target strength of its radius") {
  // TS = 20 log10(a / 2) [Urick1983] for a plane wave. A convex mirror at 15 m is seen at the range r of its front on
  // the way out and spreads from behind it: 20 log10(r) + 20 log10(r + a) instead of 40 log10. Only the upper half
  // exists, in a hole: what answers is where the sphere faces the head, 2 a s = 0.2 a wide by the slopes of its facets
  // (rms 0.1), each a / 40 wide. Beams of 10 degrees; the echo's energy over the pulse.
  const seabed::Law rigid = seabed::law_of(*seabed::material_of("rigid"), 300e3, kSpeed_mps);
  for (const double radius_m : {0.5, 1.0, 2.0}) {
    for (const double beam_deg : {0.0, 35.0}) {
      const MillsCross cross{
          .elements = 10, .spacing_in_waves = 0.5, .absorption_dbpm = 0.07, .range_m = 25.0, .quality = 2.0};
      const frames::Vec3 towards(std::sin(beam_deg * kDeg), 0.0, -std::cos(beam_deg * kDeg));  // starboard is east
      const frames::Vec3 centre = 15.0 * towards;
      const trace::Scene ball = scene_of(25.0, radius_m / 40.0, [&](double east, double north) {
        const double r2 = std::pow(east - centre.x(), 2) + std::pow(north - centre.y(), 2);
        return r2 < radius_m * radius_m ? centre.z() + std::sqrt(radius_m * radius_m - r2) : std::nan("");
      });
      const std::vector<float> sine{static_cast<float>(std::sin(beam_deg * kDeg))};
      const echo::Image image = cross.receive(ball, {}, rigid, sine);
      const double level_db = db(energy_upa2s(cross, image, 0) / cross.pulse_length_s), front_m = 15.0 - radius_m;
      const double strength_db =
          level_db - cross.source_level_db + 2.0 * db(front_m * 15.0) + 2.0 * cross.absorption_dbpm * front_m;
      INFO("radius " << radius_m << " m, " << beam_deg << " deg: TS " << strength_db << " dB");
      CHECK_THAT(strength_db, WithinAbs(20.0 * std::log10(0.5 * radius_m), 0.5));
    }
  }
}
