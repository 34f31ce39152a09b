// Rays to bodies: RayDistribution's, as those to facets of tiles are.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "kernels/acoustics/trace/towards.h"

namespace ensonify::trace {
namespace {

using frames::Vec3;
using solids::Facet;

constexpr double kFewestRays = 64.0;      // of a body, at any quality
constexpr std::size_t kMostToBodies = 4;  // of all rays one in so many
constexpr double kWithin_m = 0.01;        // a hit counts so far beyond its facet, for what bending misplaces
constexpr std::uint64_t kBodies = 0x626f64696573ULL;  // of the stream

Vec3 middle_of(const Facet& facet) { return (facet.corners[0] + facet.corners[1] + facet.corners[2]) / 3.0; }

Vec3 across(const Facet& facet) {
  return (facet.corners[1] - facet.corners[0]).cross(facet.corners[2] - facet.corners[0]);
}

double longest_side_m(const Facet& facet) {
  double longest_m = 0.0;
  for (std::size_t c = 0; c < 3; ++c)
    longest_m = std::max(longest_m, (facet.corners[(c + 1) % 3] - facet.corners[c]).norm());
  return longest_m;
}

bool faces(const Facet& facet, const Vec3& head_enu_m, bool two_sided) {
  return two_sided || across(facet).dot(head_enu_m - middle_of(facet)) > 0.0;
}

/// Sides of facets of smooth bodies at a distance: a quarter of the Fresnel zone, so that the wave is plane across
/// them, and half of what is resolved along the way.
double plane_side_m(double wavelength_m, double away_m, double range_resolution_m) {
  return std::min(0.25 * std::sqrt(wavelength_m * away_m), 0.5 * range_resolution_m);
}

/// Directions to the places of a body; to each of its facets anew where one fit does not hold for all of it.
class TowardsBody {
 public:
  TowardsBody(const FacetView& view, const ShownBody& body)
      : view_(view), wide_(view.refracted != nullptr && is_wide(view, body.box_enu_m)) {
    if (!wide_) whole_ = Towards::make(view, body.box_enu_m);
    each_ = view.refracted != nullptr && !whole_;
  }

  static bool is_wide(const FacetView& view, const Eigen::AlignedBox3d& box_enu_m) {
    return 0.5 * box_enu_m.diagonal().norm() > kWidest * (box_enu_m.center() - view.head.position_enu_m).norm();
  }

  /// Nothing where no path goes there.
  std::optional<Vec3> operator()(const Vec3& place_enu_m) const {
    if (!each_) return (*whole_)(place_enu_m);
    const Vec3 around = Vec3::Constant(1e-3);
    const auto towards = Towards::make(view_, {place_enu_m - around, place_enu_m + around});
    if (!towards) return std::nullopt;
    return (*towards)(place_enu_m);
  }

 private:
  const FacetView& view_;
  bool wide_, each_ = false;
  std::optional<Towards> whole_;
};

}  // namespace

void RayDistribution::aim_at_bodies(const Probes& probes, const Targets& of, const FacetView& view, FacetMemory& memory,
                                    FacetTargets& targets) const {
  targets.body_facets.clear();
  targets.bodies.clear();
  memory.body_facets.clear();
  const Vec3& head = view.head.position_enu_m;
  const auto add_ray = [&](const Vec3& direction, const BodyTarget& target) {
    if (!holds(probes, direction)) return;
    memory.rays.push_back({direction.normalized().cast<float>(), 0.0F});
    targets.body_facets.push_back(target);
  };

  std::vector<std::uint32_t> in_volume;
  double smooth_parts = 0.0;  // about how many
  for (std::uint32_t b = 0; b < of.bodies.size(); ++b) {
    const ShownBody& shown = of.bodies[b];
    if (shown.body->smooth) targets.bodies.push_back(shown.tile);
    const double half_m = 0.5 * shown.box_enu_m.diagonal().norm();
    const Vec3 off = view.head.enu_from_head.conjugate() * (shown.box_enu_m.center() - head);
    const double away_m = off.norm();
    const double radius_m = half_m + (view.refracted != nullptr ? kMostRefraction_rad * away_m : 0.0);
    if (away_m - half_m > view.max_range_m || !touches(probes, off, radius_m)) continue;
    if (!shown.body->smooth && TowardsBody::is_wide(view, shown.box_enu_m)) continue;  // as the seabed is
    in_volume.push_back(b);
    if (!shown.body->smooth) continue;
    for (std::size_t t = 0; t < shown.body->surface.mesh.triangle.size(); ++t) {
      const Facet facet = facet_of(shown.body->surface, t);
      const double side_m =
          plane_side_m(of.wavelength_m, (middle_of(facet) - head).norm(), settings_.range_resolution_m);
      smooth_parts += 1.0 + across(facet).norm() / (side_m * side_m);
    }
  }
  const auto most = static_cast<double>(settings_.most_rays / kMostToBodies);
  const double coarser = std::sqrt(std::max(1.0, smooth_parts / most));

  for (const std::uint32_t b : in_volume) {
    const ShownBody& shown = of.bodies[b];
    const Body& body = *shown.body;
    const TowardsBody towards(view, shown);
    const std::size_t first_facet = memory.body_facets.size();
    double wanted = 0.0;
    for (std::size_t t = 0; t < body.surface.mesh.triangle.size(); ++t) {
      const Facet whole = facet_of(body.surface, t);
      if (!faces(whole, head, body.two_sided)) continue;
      if (body.smooth) {
        const double side_m =
            coarser * plane_side_m(of.wavelength_m, (middle_of(whole) - head).norm(), settings_.range_resolution_m);
        solids::split_facet(whole, side_m, [&](const Facet& part) {
          const auto direction = towards(middle_of(part));
          const auto within_m = static_cast<float>(longest_side_m(part) + kWithin_m);
          if (direction)
            add_ray(*direction, {shown.tile, &body, part, static_cast<float>(0.5 * across(part).norm()), within_m,
                                 middle_of(part)});
        });
        continue;
      }
      std::array<Vec3, 3> corners;
      bool reached = true;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto direction = towards(whole.corners[c]);
        reached = reached && direction;
        if (direction) corners[c] = *direction;
      }
      if (!reached) continue;
      const double rays = rays_to_facet(probes, corners);
      if (rays > 0.0) memory.body_facets.push_back({b, static_cast<std::uint32_t>(t), whole, rays}), wanted += rays;
    }
    if (body.smooth) continue;
    targets.bodies.push_back(shown.tile);
    const double more = std::max(1.0, kFewestRays / std::max(wanted, 1e-9));
    for (std::size_t f = first_facet; f < memory.body_facets.size(); ++f) memory.body_facets[f].wanted *= more;
  }
  std::ranges::sort(targets.bodies);

  const double all = std::accumulate(memory.body_facets.begin(), memory.body_facets.end(), 0.0,
                                     [](double sum, const auto& facet) { return sum + std::max(1.0, facet.wanted); });
  const double share = std::min(1.0, most / std::max(1.0, all));
  std::optional<TowardsBody> towards;
  std::uint32_t towards_body = 0;
  for (const FacetMemory::BodyFacet& facet : memory.body_facets) {
    if (!towards || towards_body != facet.body) towards.emplace(view, of.bodies[facet.body]), towards_body = facet.body;
    const ShownBody& shown = of.bodies[facet.body];
    const auto random = stream_.bits(kBodies, shown.contributor, facet.triangle);
    const double wanted = share * facet.wanted;
    if (wanted < 1.0 && 0x1p-32 * random[0] >= wanted) continue;
    const auto count = static_cast<std::uint32_t>(std::ceil(wanted));
    const double area_m2 = 0.5 * across(facet.facet).norm() / (wanted < 1.0 ? wanted : static_cast<double>(count));
    const auto within_m = static_cast<float>(longest_side_m(facet.facet) + kWithin_m);
    for (std::uint32_t k = 0; k < count; ++k) {
      const Vec3 place = place_on(facet.facet.corners, random[1], k);
      if (const auto direction = (*towards)(place))
        add_ray(*direction, {shown.tile, shown.body.get(), facet.facet, static_cast<float>(area_m2), within_m, place});
    }
  }
}

/// Rays to bodies count where they hit near their place; others that hit such a body do not.
void RayDistribution::settle_body_rays(const FacetTargets& targets, std::size_t spread, Batch& batch) {
  Rays& rays = batch.rays;
  Hits& hits = batch.hits;
  if (!targets.bodies.empty()) {
    for (std::size_t i = 0; i < spread; ++i) {
      if (std::ranges::binary_search(targets.bodies, hits.tile[i])) hits.set(i, Hit{});
    }
  }
  const std::size_t first = rays.size() - batch.to_bodies.size();
  for (std::size_t i = first; i < rays.size(); ++i) {
    const BodyTarget& target = batch.to_bodies[i - first];
    const bool counts = hits.hit(i) && hits.tile[i] == target.tile && hits.tube_m2[i] > 0.0F &&
                        (hits.position_enu_m[i] - target.place_enu_m).norm() < static_cast<double>(target.within_m);
    rays.solid_angle_sr[i] = counts ? target.area_m2 * hits.sin_grazing[i] / hits.tube_m2[i] : 0.0F;
    if (!counts) hits.set(i, Hit{});
  }
}

}  // namespace ensonify::trace
