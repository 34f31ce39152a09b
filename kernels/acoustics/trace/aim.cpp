#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "kernels/acoustics/trace/ground_lattice.h"
#include "kernels/acoustics/trace/ray_distribution.h"
#include "kernels/base/isa/wide.h"

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

constexpr std::size_t kSome = LatticePlaces::kMost;
using Column = std::array<double, kSome>;

/// From a lattice's axes to the head's: a place's direction times its distance.
struct ToHead {
  Vec3 first, second, down;
  Vec2 head_m;
  double block_m3;  // below dA, for all places of a block
};

/// Of a part of the volume.
struct Edges {
  Vec2 from, to;
  double low, high;
  int along, zero;  // axes
};

struct Directions {
  std::array<std::array<float, kSome>, 3> unit;
  Column solid_angle_sr;                    // 0 beyond the edges
  std::array<std::uint64_t, kSome> within;  // 1, or beyond the edges 0
};

ENSONIFY_WIDE void directions_to(const ToHead& to_head, const Edges& edges, const LatticePlaces& places,
                                 Directions& found) {
  const std::size_t count = places.count;
  const Column &first_m = places.first_m, &second_m = places.second_m, &share = places.share;
  Column x, y, z;
  const auto coordinate = [&](int k, Column& at) {
    const double first = to_head.first[k], second = to_head.second[k], down = to_head.down[k];
    const double head_first = to_head.head_m.x(), head_second = to_head.head_m.y();
    for (std::size_t i = 0; i < count; ++i)
      at[i] = (first_m[i] - head_first) * first + (second_m[i] - head_second) * second + down;
  };
  coordinate(0, x), coordinate(1, y), coordinate(2, z);
  const double* const along = edges.along == 0 ? x.data() : z.data();
  const double* const zero = edges.zero == 0 ? x.data() : z.data();
  const double from_x = edges.from.x(), from_y = edges.from.y(), to_x = edges.to.x(), to_y = edges.to.y();
  const double low = edges.low, high = edges.high, block_m3 = to_head.block_m3;
  for (std::size_t i = 0; i < count; ++i) {
    const double away_m = std::sqrt(x[i] * x[i] + (y[i] * y[i] + z[i] * z[i])), per_m = 1.0 / away_m;
    found.unit[0][i] = static_cast<float>(per_m * x[i]);
    found.unit[1][i] = static_cast<float>(per_m * y[i]);
    found.unit[2][i] = static_cast<float>(per_m * z[i]);
    // As numbers: && would be a branch, and the loop no vector code.
    const auto right = static_cast<std::uint64_t>(y[i] * from_x >= zero[i] * from_y),
               left = static_cast<std::uint64_t>(y[i] * to_x < zero[i] * to_y),
               above = static_cast<std::uint64_t>(along[i] >= low * away_m),
               below = static_cast<std::uint64_t>(along[i] < high * away_m);
    found.within[i] = places.inside[i] | (right & left & above & below);
    const double solid_angle_sr = block_m3 * share[i] * per_m * per_m * per_m;  // below dA / away^3
    found.solid_angle_sr[i] = found.within[i] != 0 ? solid_angle_sr : 0.0;
  }
}

/// Those of `count` that are within the edges.
void append(const Directions& found, std::size_t count, Rays& rays, std::size_t& next) {
  if (rays.size() < next + count) rays.resize(2 * (next + count));
  float *const x = rays.direction_head.x.data(), *const y = rays.direction_head.y.data(),
               *const z = rays.direction_head.z.data(), *const solid_angle_sr = rays.solid_angle_sr.data();
  std::size_t at = next;
  for (std::size_t i = 0; i < count; ++i) {
    x[at] = found.unit[0][i], y[at] = found.unit[1][i], z[at] = found.unit[2][i];
    solid_angle_sr[at] = static_cast<float>(found.solid_angle_sr[i]);
    at += found.within[i];
  }
  next = at;
}

// Of an object, at normal quality: as many as a facet has quarters of quarters, each of which gets one
// (facet_rays.cpp). One that the volume's edge cuts has more places, for rays to those beyond it cost nothing.
constexpr double kRaysToFacet = 16.0, kCutByEdge = 4.0;
constexpr double kTurn_rad = 2.0 * std::numbers::pi;

/// From -pi to pi.
double within_turn(double angle_rad) { return angle_rad - kTurn_rad * std::nearbyint(angle_rad * (1.0 / kTurn_rad)); }

std::size_t cell_of(const std::vector<double>& edges, double at) {
  return static_cast<std::size_t>(std::upper_bound(edges.begin() + 1, edges.end() - 1, at) - edges.begin()) - 1;
}

}  // namespace

void RayDistribution::aim_at_places(const Part& part, const Place& view, Aimed* aimed, ToPlaces* counted) const {
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
  if (!footprint) return;
  const double phi_m = footprint->along_phi_m.norm();
  const GroundLattice lattice(footprint->along_phi_m, phi_m / part.along_angle,
                              footprint->area_m2 / phi_m / part.along_sine);
  const Vec2 head_m = lattice.on_axes(view.head.position_enu_m.head<2>());
  for (Vec2& corner : footprint->outline_m) corner = lattice.on_axes(corner) + head_m;

  const Eigen::Matrix3d head_from_enu = view.enu_from_head.transpose();
  const Vec3 first = head_from_enu.leftCols<2>() * lattice.first_axis_enu(),
             second = head_from_enu.leftCols<2>() * lattice.second_axis_enu(), down = -below_m * head_from_enu.col(2);
  const double block_m3 = below_m * lattice.block_m2();
  const int along_row = forward ? 0 : 2, zero_row = forward ? 2 : 0;
  const auto inside = aimed != nullptr ? GroundLattice::Inside::kPlaces : GroundLattice::Inside::kBlocks;
  Directions found;
  lattice.within(stream_, footprint->outline_m, footprint->bulge_m, inside, [&](const LatticePlaces& some) {
    directions_to({first, second, down, head_m, block_m3}, {from, to, low, high, along_row, zero_row}, some, found);
    if (aimed != nullptr) append(found, some.count, aimed->rays, aimed->count);
    if (counted == nullptr) return;
    for (std::size_t i = 0; i < some.count; ++i) {
      counted->solid_angle_sr += found.solid_angle_sr[i];
      counted->rays += found.within[i] * some.places[i];
    }
  });
}

std::array<double, 2> RayDistribution::coordinates_of(const Probes& probes, const Vec3& direction_head) const {
  const bool forward = volume_.axis == TransmitVolume::Axis::kForward;
  const double along = forward ? direction_head.x() : direction_head.z(),
               zero = forward ? direction_head.z() : direction_head.x();
  const double middle_rad = 0.5 * (probes.angle_edges_rad.front() + probes.angle_edges_rad.back());
  return {along / direction_head.norm(), middle_rad + within_turn(std::atan2(direction_head.y(), zero) - middle_rad)};
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
    phi[c] = c == 0 ? angle_rad : phi[0] + within_turn(angle_rad - phi[0]);
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
