// Rays to bodies: RayDistribution's, as those to facets of tiles are.
#include <algorithm>
#include <cmath>
#include <optional>

#include "kernels/acoustics/trace/towards.h"

namespace ensonify::trace {
namespace {

using frames::Vec3;
using solids::Facet;

constexpr double kFewestRays = 64.0;       // of a body, at any quality
constexpr double kOfFacetOfTile = 0.25;    // rays to a piece over those to a facet of a tile
constexpr double kPieceOverRadius = 0.25;  // no piece of a body is larger
constexpr double kMostToBodies = 8.0;      // of all rays one in so many
constexpr double kWithin_m = 0.01;         // a hit counts so far beyond its piece, for what bending misplaces
constexpr std::uint64_t kBodies = 0x626f64696573ULL;  // of the stream

double longest_side_m(const Facet& facet) {
  double longest_m = 0.0;
  for (std::size_t c = 0; c < 3; ++c)
    longest_m = std::max(longest_m, (facet.corners[(c + 1) % 3] - facet.corners[c]).norm());
  return longest_m;
}

/// Of the sphere about its middle that holds all of a facet.
double reach_m(const Facet& facet) {
  const Vec3 middle = middle_of(facet);
  double reach = 0.0, bulge = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    reach = std::max(reach, (facet.corners[c] - middle).norm());
    bulge = std::max(bulge, std::abs(facet.bulge_m[c]));
  }
  return reach + bulge;
}

bool faces(const Facet& facet, const Vec3& head_enu_m, bool two_sided) {
  return two_sided || across(facet).dot(head_enu_m - middle_of(facet)) > 0.0;
}

bool is_wide(const FacetView& view, const Eigen::AlignedBox3d& box_enu_m) {
  return 0.5 * box_enu_m.diagonal().norm() > kWidest * (box_enu_m.center() - view.head.position_enu_m).norm();
}

/// Directions to the places of a body; to each anew where one fit does not hold for all of it.
class TowardsBody {
 public:
  TowardsBody(const FacetView& view, const ShownBody& body) : view_(view) {
    if (view.refracted == nullptr || !is_wide(view, body.box_enu_m)) whole_ = Towards::make(view, body.box_enu_m);
  }

  /// Nothing where no path goes there.
  std::optional<Vec3> operator()(const Vec3& place_enu_m) const {
    if (whole_) return (*whole_)(place_enu_m);
    const Vec3 around = Vec3::Constant(1e-3);
    const auto towards = Towards::make(view_, {place_enu_m - around, place_enu_m + around});
    if (!towards) return std::nullopt;
    return (*towards)(place_enu_m);
  }

 private:
  const FacetView& view_;
  std::optional<Towards> whole_;
};

/// How large the pieces of bodies are that rays go to.
struct PieceSize {
  const Targets& of;
  double range_resolution_m;
  double coarser = 1.0;  // of smooth ones, where there would be too many

  /// Of a smooth body: a quarter of the Fresnel zone, so that the wave is plane across it, and half of what is resolved
  /// along the way. Of others: as patches of seabed are.
  double side_m(const ShownBody& shown, double away_m) const {
    if (shown.body->smooth)
      return coarser * std::min(0.25 * std::sqrt(of.wavelength_m * away_m), 0.5 * range_resolution_m);
    return std::min(of.patch_m, kPieceOverRadius * 0.5 * shown.box_enu_m.diagonal().norm());
  }
};

/// About how many pieces the smooth ones among these bodies have.
double count_smooth(std::span<const std::uint32_t> bodies, const Targets& of, const Vec3& head, const PieceSize& size) {
  double count = 0.0;
  for (const std::uint32_t b : bodies) {
    const ShownBody& shown = of.bodies[b];
    if (!shown.body->smooth) continue;
    for (std::size_t t = 0; t < shown.body->surface.mesh.triangle.size(); ++t) {
      const Facet facet = facet_of(shown.body->surface, t);
      const double side_m = size.side_m(shown, (middle_of(facet) - head).norm());
      count += 1.0 + across(facet).norm() / (side_m * side_m);
    }
  }
  return count;
}

}  // namespace

void RayDistribution::aim_at_bodies(const Probes& probes, const Targets& of, const FacetView& view, FacetMemory& memory,
                                    FacetTargets& targets) const {
  targets.body_pieces.clear();
  targets.bodies.clear();
  memory.pieces.clear();
  const Vec3& head = view.head.position_enu_m;
  std::vector<std::uint32_t> bodies;  // in the volume
  for (std::uint32_t b = 0; b < of.bodies.size(); ++b) {
    const ShownBody& shown = of.bodies[b];
    const bool as_seabed = !shown.body->smooth && is_wide(view, shown.box_enu_m);
    if (!as_seabed) targets.bodies.push_back(shown.tile);
    const double half_m = 0.5 * shown.box_enu_m.diagonal().norm();
    const Vec3 off = view.head.enu_from_head.conjugate() * (shown.box_enu_m.center() - head);
    const double away_m = off.norm();
    const double radius_m = half_m + (view.refracted != nullptr ? kMostRefraction_rad * away_m : 0.0);
    if (away_m - half_m > view.max_range_m || as_seabed || !touches(probes, off, radius_m)) continue;
    bodies.push_back(b);
  }
  std::ranges::sort(targets.bodies);
  if (bodies.empty()) return;

  const double most = static_cast<double>(settings_.most_rays) / kMostToBodies;
  PieceSize size{of, settings_.range_resolution_m};
  size.coarser = std::sqrt(std::max(1.0, count_smooth(bodies, of, head, size) / most));
  for (const std::uint32_t b : bodies) gather_pieces(probes, of, b, view, size.coarser, memory);

  double rough = 0.0;
  for (const FacetMemory::Piece& piece : memory.pieces)
    rough += of.bodies[piece.body].body->smooth ? 0.0 : std::max(1.0, piece.wanted);
  const double share = std::min(1.0, most / std::max(1.0, rough));
  std::optional<TowardsBody> towards;
  std::uint32_t towards_body = 0;
  for (const FacetMemory::Piece& piece : memory.pieces) {
    if (!towards || towards_body != piece.body) towards.emplace(view, of.bodies[piece.body]), towards_body = piece.body;
    const ShownBody& shown = of.bodies[piece.body];
    const bool smooth = shown.body->smooth;
    const auto random = stream_.bits(kBodies, shown.contributor, piece.number);
    const double wanted = smooth ? 1.0 : share * piece.wanted;
    if (wanted < 1.0 && 0x1p-32 * random[0] >= wanted) continue;
    const auto count = static_cast<std::uint32_t>(std::ceil(wanted));
    const double area_m2 = 0.5 * across(piece.facet).norm() / (wanted < 1.0 ? wanted : static_cast<double>(count));
    const auto within_m = static_cast<float>(longest_side_m(piece.facet) + kWithin_m);
    for (std::uint32_t k = 0; k < count; ++k) {
      const Vec3 place = smooth ? middle_of(piece.facet) : place_on(piece.facet.corners, random[1], k);
      const auto direction = (*towards)(place);
      if (!direction || !holds(probes, *direction)) continue;
      memory.rays.push_back({direction->normalized().cast<float>(), 0.0F});
      targets.body_pieces.push_back(
          {shown.tile, shown.body.get(), piece.facet, piece.number, static_cast<float>(area_m2), within_m, place});
    }
  }
}

/// The pieces of a body that face the head, and how many rays they want.
void RayDistribution::gather_pieces(const Probes& probes, const Targets& of, std::uint32_t body, const FacetView& view,
                                    double coarser, FacetMemory& memory) const {
  const ShownBody& shown = of.bodies[body];
  const Vec3& head = view.head.position_enu_m;
  const PieceSize size{of, settings_.range_resolution_m, coarser};
  const TowardsBody towards(view, shown);
  const auto meets = [&](const Facet& facet) {  // the volume, with room for what bending turns
    const Vec3 off = middle_of(facet) - head;
    const double radius_m = reach_m(facet) + (view.refracted != nullptr ? kMostRefraction_rad * off.norm() : 0.0);
    return touches(probes, view.head.enu_from_head.conjugate() * off, radius_m);
  };
  const std::size_t first = memory.pieces.size();
  double wanted = 0.0;
  for (std::size_t t = 0; t < shown.body->surface.mesh.triangle.size(); ++t) {
    const Facet whole = facet_of(shown.body->surface, t);
    if (!faces(whole, head, shown.body->two_sided)) continue;
    const auto add = [&](const Facet& facet, std::uint32_t way) {
      const FacetMemory::Piece piece{body, std::uint64_t{t} << 32 | way, facet, 1.0};
      if (shown.body->smooth) return memory.pieces.push_back(piece);
      std::array<Vec3, 3> corners;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto direction = towards(facet.corners[c]);
        if (!direction) return;
        corners[c] = *direction;
      }
      const double rays = rays_to_facet(probes, corners);
      if (!(rays > 0.0)) return;
      memory.pieces.push_back(piece);
      memory.pieces.back().wanted = std::max(std::min(rays, 1.0), kOfFacetOfTile * rays);
      wanted += memory.pieces.back().wanted;
    };
    split_facet_where(meets, whole, size.side_m(shown, (middle_of(whole) - head).norm()), add);
  }
  if (shown.body->smooth) return;
  const double more = std::max(1.0, kFewestRays / std::max(wanted, 1e-9));
  for (std::size_t f = first; f < memory.pieces.size(); ++f) memory.pieces[f].wanted *= more;
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
