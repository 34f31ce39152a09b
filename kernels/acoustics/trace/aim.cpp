#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "kernels/acoustics/trace/ground_lattice.h"
#include "kernels/acoustics/trace/ray_distribution.h"

namespace ensonify::trace {
namespace {

using frames::Vec2;
using frames::Vec3;

constexpr double kLeastFall = 0.01;   // sine of the angle at which rays fall on the plane
constexpr double kMostStretch = 2.0;  // farthest over nearest place of a part
constexpr double kRestOfBulge = 0.3;  // of an edge's, beyond the two chords that stand for it: a quarter and a little

/// What a part of the volume covers on a plane, from the point below the head. Edges of one angle are straight lines
/// there, those of one sine are not, and have a corner in their middle.
struct Footprint {
  std::array<Vec2, 6> outline_m;
  Vec2 along_phi_m, along_u_m;  // mean edges
  double area_m2, bulge_m;      // how far the outline may lie inside the edges
};

/// Of directions (enu) in the outline's order: three of the low sine as angles rise, three of the high one as they
/// fall. None where the plane is seen too flat.
std::optional<Footprint> footprint_of(const std::array<Vec3, 6>& directions, double below_m) {
  Footprint f;
  double least_fall = 1.0, most_fall = 0.0;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const double fall = -directions[k].z();
    if (!(fall >= kLeastFall)) return std::nullopt;
    least_fall = std::min(least_fall, fall), most_fall = std::max(most_fall, fall);
    f.outline_m[k] = below_m / fall * directions[k].head<2>();
  }
  const auto& p = f.outline_m;
  f.along_phi_m = 0.5 * (p[2] - p[0] + p[3] - p[5]);
  f.along_u_m = 0.5 * (p[5] - p[0] + p[3] - p[2]);
  f.area_m2 = std::abs(f.along_phi_m.x() * f.along_u_m.y() - f.along_phi_m.y() * f.along_u_m.x());
  f.bulge_m = kRestOfBulge * std::max((p[1] - 0.5 * (p[0] + p[2])).norm(), (p[4] - 0.5 * (p[3] + p[5])).norm());
  if (most_fall > kMostStretch * least_fall || !(f.area_m2 > 0.0)) return std::nullopt;
  return f;
}

// Of an object, at normal quality: as many as a facet has quarters of quarters, each of which gets one
// (facet_rays.cpp). One that the volume's edge cuts has more places, for rays to those beyond it cost nothing.
constexpr double kRaysToFacet = 16.0, kCutByEdge = 4.0;
constexpr double kTurn_rad = 2.0 * std::numbers::pi;

std::size_t cell_of(const std::vector<double>& edges, double at) {
  return static_cast<std::size_t>(std::upper_bound(edges.begin() + 1, edges.end() - 1, at) - edges.begin()) - 1;
}

}  // namespace

RayDistribution::ToPlaces RayDistribution::aim_at_places(const Part& part, const Place& view,
                                                         std::vector<Ray>* rays) const {
  const bool forward = volume_.axis == TransmitVolume::Axis::kForward;
  const double low = part.low_sine, high = part.high_sine, below_m = part.need.plane_m;
  const Vec2 from(std::cos(part.low_rad), std::sin(part.low_rad)), to(std::cos(part.high_rad), std::sin(part.high_rad));
  const Vec2 middle = (from + to).normalized();
  const auto direction = [&](double u, const Vec2& angle) {
    const double beside = std::sqrt(1.0 - u * u), side = beside * angle.y(), zero = beside * angle.x();
    return Vec3(view.enu_from_head * (forward ? Vec3(u, side, zero) : Vec3(zero, side, u)));
  };
  auto footprint = footprint_of({direction(low, from), direction(low, middle), direction(low, to), direction(high, to),
                                 direction(high, middle), direction(high, from)},
                                below_m);
  if (!footprint) return {};
  const double phi_m = footprint->along_phi_m.norm();
  const GroundLattice lattice(footprint->along_phi_m, phi_m / part.along_angle,
                              footprint->area_m2 / phi_m / part.along_sine);
  const Vec2 head_m = lattice.on_axes(view.head.position_enu_m.head<2>());
  for (Vec2& corner : footprint->outline_m) corner = lattice.on_axes(corner) + head_m;

  // A place's direction times its distance, and which side of the part's edges it is on.
  const Eigen::Matrix3d head_from_enu = view.enu_from_head.transpose();
  const Vec3 first = head_from_enu.leftCols<2>() * lattice.first_axis_enu(),
             second = head_from_enu.leftCols<2>() * lattice.second_axis_enu(), down = -below_m * head_from_enu.col(2);
  const double block_m3 = below_m * lattice.block_m2();
  ToPlaces to_places;
  lattice.within(stream_, footprint->outline_m, footprint->bulge_m, [&](double first_m, double second_m, double share) {
    const Vec3 there = (first_m - head_m.x()) * first + (second_m - head_m.y()) * second + down;
    const double along = forward ? there.x() : there.z(), side = there.y(), zero = forward ? there.z() : there.x();
    if (side * from.x() < zero * from.y() || side * to.x() >= zero * to.y()) return;
    const double away_m = there.norm();
    if (along < low * away_m || along >= high * away_m) return;
    const double per_m = 1.0 / away_m, solid_angle_sr = block_m3 * share * per_m * per_m * per_m;  // below dA / away^3
    if (rays) rays->push_back({(per_m * there).cast<float>(), static_cast<float>(solid_angle_sr)});
    to_places.solid_angle_sr += solid_angle_sr;
    ++to_places.rays;
  });
  return to_places;
}

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
