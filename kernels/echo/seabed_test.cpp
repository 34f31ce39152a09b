#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/array/line.h"
#include "kernels/echo/echo.h"
#include "kernels/seabed/lambert.h"

using namespace ensonify;
using frames::Vec3;

constexpr double kDeg = std::numbers::pi / 180.0;

/// A plane seabed 20 m below the origin, tilted up towards starboard of a head that looks north, as posts and
/// triangles.
struct Case {
  double tilt_rad = 0.0;     // of the seabed, and with it of the head
  double heading_rad = 0.0;  // of the head, and with it of the seabed
  double spacing_m = 0.5;
};

/// Mean echo energy over pings in a beam 45 deg to starboard, any unit, through Embree.
static double energy(const Case& c) {
  const Vec3 normal = enu_from_body(frames::Attitude{c.heading_rad, 0.0, -c.tilt_rad}) * Vec3(0, 0, -1);
  const frames::HeadPose head{{0, 0, 0}, enu_from_body(frames::Attitude{c.heading_rad, 0.0, -c.tilt_rad})};
  trace::Scene scene({0, 0});
  const auto cells = static_cast<std::int32_t>(std::lround(256 / c.spacing_m));
  scene.insert({0, 0}, terrain::sample_tile(
                           {.origin_enu_m = {-128, -128}, .spacing_m = c.spacing_m, .cells = cells}, {0, 0},
                           [&](double x, double y) { return (-20.0 - normal.x() * x - normal.y() * y) / normal.z(); }));
  echo::Sonar sonar;
  sonar.transmit_length_in_waves = sonar.receive_length_in_waves = array::length_in_waves_for(1.0 * kDeg);
  std::vector<float> beams;
  for (int i = -3; i <= 3; ++i) beams.push_back(static_cast<float>(std::sin((45 + 1.5 * i) * kDeg)));
  const std::vector<frames::HeadPose> rest{head};
  const trace::Fan fan({.transmit_length_in_waves = sonar.transmit_length_in_waves, .half_swath_rad = 60 * kDeg});
  std::vector<trace::Ray> rays;
  std::vector<trace::Hit> hits;
  std::vector<float> backscatter;
  echo::Workspace workspace;
  echo::Image image;
  double sum = 0.0;
  for (std::uint64_t ping = 0; ping < 60; ++ping) {
    fan.fill({2, "rays"}, ping, rays);
    scene.trace(head, rays, 100.0F, hits);
    backscatter.clear();
    for (const auto& hit : hits) backscatter.push_back(float(seabed::lambert_backscatter(-25, hit.sin_grazing)));
    accumulate(sonar, beams, {30e-3, 40e-6, 500}, {ping, rays, hits, backscatter}, {0, 1, rest}, {3, "phase"},
               workspace, image);
    for (const auto p : image.envelope_upa) sum += std::norm(p);
  }
  return sum;
}

// The same rays and phases are used throughout, so the speckle is nearly the same and the ratios are much closer than
// chance allows.

TEST_CASE("the level does not depend on the fineness of the mesh") {
  const double level = energy({.tilt_rad = 0.1, .spacing_m = 1.0});
  CHECK(10 * std::log10(energy({.tilt_rad = 0.1, .spacing_m = 0.25}) / level) == Approx(0).margin(0.2));
}

TEST_CASE("the level does not depend on the frame of the terrain") {
  const double level = energy({});
  CHECK(10 * std::log10(energy({.heading_rad = 1.1}) / level) == Approx(0).margin(0.2));
  CHECK(10 * std::log10(energy({.tilt_rad = 0.2}) / level) == Approx(0).margin(0.2));
  CHECK(10 * std::log10(energy({.tilt_rad = -0.3, .heading_rad = 4.0}) / level) == Approx(0).margin(0.2));
}

TEST_CASE("a slope that faces the beam echoes stronger than one that turns away") {
  // Not an invariance: the head stays level. At 45 deg, grazing 45 +- 11.5 deg, the range changes too; the sign must be
  // right.
  trace::Scene facing({0, 0}), averted({0, 0});
  const terrain::TileGrid grid{.origin_enu_m = {-64, -64}, .spacing_m = 0.5, .cells = 256};
  facing.insert({0, 0}, terrain::sample_tile(grid, {0, 0}, [](double x, double) { return -20 + 0.2 * (x - 20); }));
  averted.insert({0, 0}, terrain::sample_tile(grid, {0, 0}, [](double x, double) { return -20 - 0.2 * (x - 20); }));
  const std::vector<trace::Ray> ray{{{0.0F, float(std::sqrt(0.5)), float(std::sqrt(0.5))}, 1e-4F}};
  std::vector<trace::Hit> near_hit, far_hit;
  facing.trace({}, ray, 100.0F, near_hit);
  averted.trace({}, ray, 100.0F, far_hit);
  CHECK(near_hit[0].sin_grazing == Approx(std::sin(45 * kDeg + std::atan(0.2))).epsilon(1e-3));
  CHECK(far_hit[0].sin_grazing == Approx(std::sin(45 * kDeg - std::atan(0.2))).epsilon(1e-3));
}
