#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "kernels/acoustics/trace/ray_distribution.h"

namespace ensonify::trace {
namespace {

using frames::Vec3;

// Of an object, at normal quality: as many as a facet has quarters of quarters, each of which gets one
// (facet_rays.cpp). One that the volume's edge cuts has more places, for rays to those beyond it cost nothing.
constexpr double kRaysToFacet = 16.0, kCutByEdge = 4.0;
constexpr double kTurn_rad = 2.0 * std::numbers::pi;

std::size_t cell_of(const std::vector<double>& edges, double at) {
  return static_cast<std::size_t>(std::upper_bound(edges.begin() + 1, edges.end() - 1, at) - edges.begin()) - 1;
}

}  // namespace

std::array<double, 2> RayDistribution::coordinates_of(const Probes& probes, const Vec3& direction_head) const {
  const bool forward = volume_.axis == TransmitVolume::Axis::kForward;
  const double along = forward ? direction_head.x() : direction_head.z(),
               zero = forward ? direction_head.z() : direction_head.x();
  const double middle_rad = 0.5 * (probes.angle_edges_rad.front() + probes.angle_edges_rad.back());
  return {along / direction_head.norm(),
          middle_rad + std::remainder(std::atan2(direction_head.y(), zero) - middle_rad, kTurn_rad)};
}

bool RayDistribution::holds(const Probes& probes, const Vec3& direction_head) const {
  const auto [sine, angle_rad] = coordinates_of(probes, direction_head);
  return probes.sine_edges.front() <= sine && sine <= probes.sine_edges.back() &&
         probes.angle_edges_rad.front() <= angle_rad && angle_rad <= probes.angle_edges_rad.back();
}

/// Whether a ball may reach into the volume, by its sines: beside a narrow fan, which most objects are.
bool RayDistribution::touches(const Probes& probes, const Vec3& middle_head_m, double radius_m) const {
  const double sine = coordinates_of(probes, middle_head_m)[0], half = radius_m / middle_head_m.norm();
  return sine + half >= probes.sine_edges.front() && sine - half <= probes.sine_edges.back();
}

/// As need() has it for resolution cells, of which a triangle is half a rectangle.
double RayDistribution::rays_to_facet(const Probes& probes, const std::array<Vec3, 3>& corners_head_m) const {
  std::array<double, 3> u, phi, r;
  for (std::size_t c = 0; c < 3; ++c) {
    r[c] = corners_head_m[c].norm();
    const auto [sine, angle_rad] = coordinates_of(probes, corners_head_m[c]);
    u[c] = sine;
    phi[c] = c == 0 ? angle_rad : phi[0] + std::remainder(angle_rad - phi[0], kTurn_rad);
  }
  const auto [low_u, high_u] = std::ranges::minmax(u);
  const auto [low_phi, high_phi] = std::ranges::minmax(phi);
  const auto [low_r, high_r] = std::ranges::minmax(r);
  if (high_u < probes.sine_edges.front() || low_u > probes.sine_edges.back() ||
      high_phi < probes.angle_edges_rad.front() || low_phi > probes.angle_edges_rad.back()) {
    return 0.0;
  }
  const double beams_u = (high_u - low_u) / volume_.sine.beam,
               beams_phi = (high_phi - low_phi) / volume_.angle_rad.beam;
  const double ranges = (high_r - low_r) / settings_.range_resolution_m;
  const double resolution = 0.5 * kRaysPerCell * std::max(beams_u * beams_phi, ranges * (beams_u + beams_phi));
  const std::size_t cell = cell_of(probes.sine_edges, 0.5 * (low_u + high_u)) * columns() +
                           cell_of(probes.angle_edges_rad, 0.5 * (low_phi + high_phi));
  const bool cut = low_u < probes.sine_edges.front() || high_u > probes.sine_edges.back() ||
                   low_phi < probes.angle_edges_rad.front() || high_phi > probes.angle_edges_rad.back();
  const double whole = cut ? kCutByEdge * kRaysToFacet : kRaysToFacet;
  return std::max(1.0, settings_.quality * std::max(whole, resolution)) * importance_of(cell);
}

}  // namespace ensonify::trace
