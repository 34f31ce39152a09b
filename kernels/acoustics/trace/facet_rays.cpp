#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "kernels/acoustics/trace/ray_distribution.h"
#include "kernels/water/refraction/eigenray.h"

namespace ensonify::trace {
namespace {

using frames::Vec2;
using frames::Vec3;

constexpr double kWidest = 0.5;              // of an object, from its middle, over its distance
constexpr double kMostRefraction_rad = 0.3;  // to search for it where straight rays would see it
constexpr double kSpread_rad = 0.02;         // of what bending does to the directions of one object
constexpr double kWithinFacet = 0.95;        // rays keep off its edges: which of two facets they hit there is rounding
constexpr std::uint32_t kLevels = 10;        // of a facet's places: a million
constexpr std::size_t kMostToFacets = 4;     // of all rays one in so many
constexpr std::uint64_t kPlaces = 0x6661636574ULL;  // of the stream

std::uint32_t facet_number(const terrain::Tile& tile, std::int32_t column, std::int32_t row, bool upper) {
  return 2 * static_cast<std::uint32_t>(row * tile.columns + column) + (upper ? 1U : 0U);
}

/// A cell is cut from its north-west to its south-east corner (lod::Patch).
std::uint32_t facet_at(const terrain::Tile& tile, const Vec3& place_enu_m) {
  const Vec2 at = (place_enu_m.head<2>() - tile.origin_enu_m) / tile.spacing_m;
  const auto cell = [](double posts, std::int32_t count) {
    return std::clamp(static_cast<std::int32_t>(std::floor(posts)), 0, count - 2);
  };
  const std::int32_t column = cell(at.x(), tile.columns), row = cell(at.y(), tile.rows);
  return facet_number(tile, column, row, at.x() - column + at.y() - row > 1.0);
}

/// Launch directions towards the places of one object.
class Towards {
 public:
  /// Empty where no path, or no single one, goes to its corners.
  static std::optional<Towards> make(const FacetView& view, const Eigen::AlignedBox3d& box_enu_m) {
    Towards towards(view.head);
    if (view.refracted == nullptr) return towards;
    const Vec3 &head = view.head.position_enu_m, middle = box_enu_m.center();
    const double half_m = 0.5 * box_enu_m.sizes().head<2>().norm();
    const double off_m = (middle - head).head<2>().norm();
    towards.near_m_ = std::max(0.0, off_m - half_m), towards.wide_m_ = off_m + half_m - towards.near_m_;
    towards.top_m_ = head.z() - box_enu_m.max().z(), towards.tall_m_ = std::max(1e-3, box_enu_m.sizes().z());
    double least = 1.0, most = -1.0;
    for (std::size_t c = 0; c < 4; ++c) {
      const double across_m = towards.near_m_ + (c % 2 == 1 ? towards.wide_m_ : 0.0);
      const double below_m = towards.top_m_ + (c >= 2 ? towards.tall_m_ : 0.0);
      const double from_m = view.refracted->source_depth_m();
      const auto path = refraction::eigenray(view.refracted->profile(), from_m, across_m, from_m + below_m);
      if (!path) return std::nullopt;
      towards.turned_rad_[c] = across_m > 0.0 ? path->launch_depression_rad - std::atan2(below_m, across_m) : 0.0;
      least = std::min(least, towards.turned_rad_[c]), most = std::max(most, towards.turned_rad_[c]);
    }
    if (most - least > kSpread_rad) return std::nullopt;
    towards.refracted_ = true;
    return towards;
  }

  /// Direction times distance, head frame.
  Vec3 operator()(const Vec3& place_enu_m) const {
    Vec3 off = place_enu_m - head_enu_m_;
    const double across_m = off.head<2>().norm();
    if (refracted_ && across_m > 0.0) {
      const double a = (across_m - near_m_) / wide_m_, b = (-off.z() - top_m_) / tall_m_;
      const double turned_rad =
          std::lerp(std::lerp(turned_rad_[0], turned_rad_[1], a), std::lerp(turned_rad_[2], turned_rad_[3], a), b);
      const double depression_rad = std::atan2(-off.z(), across_m) + turned_rad, away_m = off.norm();
      const Vec2 outwards = off.head<2>() / across_m;
      off << away_m * std::cos(depression_rad) * outwards, -away_m * std::sin(depression_rad);
    }
    return head_from_enu_ * off;
  }

 private:
  explicit Towards(const frames::HeadPose& head)
      : head_enu_m_(head.position_enu_m), head_from_enu_(head.enu_from_head.toRotationMatrix().transpose()) {}

  Vec3 head_enu_m_;
  Eigen::Matrix3d head_from_enu_;
  bool refracted_ = false;
  double near_m_ = 0.0, wide_m_ = 1.0, top_m_ = 0.0, tall_m_ = 1.0;  // distances and depths below the head
  std::array<double, 4> turned_rad_{};  // by bending: near and far at the top, near and far at the bottom
};

/// A place of a triangle: the k-th of a sequence that fills it evenly [Basu2014]. The digits of k in base 4, the lowest
/// first, say which of the four triangles between the middles of the sides, and again within it. Random digits turn
/// them, so that each place is as likely as any other.
Vec3 place_on(const std::array<Vec3, 3>& corners, std::uint32_t turn, std::uint32_t k) {
  const Vec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0;
  const std::array<Vec3, 4> off{corners[0] - centre, corners[1] - centre, corners[2] - centre, Vec3::Zero()};
  Vec3 place = centre;
  double size = kWithinFacet;
  for (std::uint32_t digits = turn ^ k, level = 0; level < kLevels; ++level, digits >>= 2) {
    const std::uint32_t which = digits & 3U;
    size *= which < 3 ? 0.5 : -0.5;  // the middle one stands on its head
    place += size * off[which];
  }
  return place;
}

void take(const Object& object, FacetTargets& targets) {
  if (targets.tiles.empty() || targets.tiles.back().tile != object.tile) {
    targets.tiles.push_back({object.number, object.tile, targets.cells.size()});
    targets.cells.resize(targets.cells.size() + object.tile->height_m.size());
  }
  for (std::int32_t row = object.first_row; row < object.end_row; ++row) {
    for (std::int32_t column = object.first_column; column < object.end_column; ++column) {
      targets.cells[targets.tiles.back().first_cell + object.tile->post(column, row)] = true;
    }
  }
}

/// Of a hit on a tile that has such cells, at full detail: its facets are those of the posts. Else null.
const FacetTargets::Tile* tile_of(const FacetTargets& targets, std::uint32_t tile, float facet_m) {
  const auto at = std::ranges::lower_bound(targets.tiles, tile, {}, &FacetTargets::Tile::number);
  const bool has = at != targets.tiles.end() && at->number == tile;
  return has && facet_m == static_cast<float>(at->tile->spacing_m) ? &*at : nullptr;
}

}  // namespace

void RayDistribution::gather_facets(const Probes& probes, std::span<const Object> objects, const FacetView& view,
                                    std::vector<FacetMemory::Facet>& facets, FacetTargets& targets) const {
  facets.clear();
  for (std::size_t o = 0; o < objects.size(); ++o) {
    const Object& object = objects[o];
    const double half_m = 0.5 * object.box_enu_m.diagonal().norm();
    const Vec3 off = view.head.enu_from_head.conjugate() * (object.box_enu_m.center() - view.head.position_enu_m);
    const double away_m = off.norm(),
                 radius_m = half_m + (view.refracted != nullptr ? kMostRefraction_rad * away_m : 0.0);
    if (away_m - half_m > view.max_range_m || half_m > kWidest * away_m || !touches(probes, off, radius_m)) continue;
    const auto towards = Towards::make(view, object.box_enu_m);
    if (!towards) continue;
    take(object, targets);
    const terrain::Tile& tile = *object.tile;
    for (std::int32_t row = object.first_row; row < object.end_row; ++row) {
      for (std::int32_t column = object.first_column; column < object.end_column; ++column) {
        const Vec3 sw = tile.position_enu_m(column, row), se = tile.position_enu_m(column + 1, row),
                   nw = tile.position_enu_m(column, row + 1), ne = tile.position_enu_m(column + 1, row + 1);
        if (!std::isfinite(sw.z() + se.z() + nw.z() + ne.z())) continue;
        for (const bool upper : {false, true}) {
          const std::array<Vec3, 3> corners{upper ? ne : sw, nw, se};
          const double wanted =
              rays_to_facet(probes, {(*towards)(corners[0]), (*towards)(corners[1]), (*towards)(corners[2])});
          if (!(wanted > 0.0)) continue;
          const double area_m2 = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
          facets.push_back({{object.number, facet_number(tile, column, row, upper), static_cast<float>(area_m2)},
                            corners,
                            o,
                            wanted});
        }
      }
    }
  }
  std::ranges::sort(targets.tiles, {}, &FacetTargets::Tile::number);
}

void RayDistribution::aim_at_facets(const Probes& probes, std::span<const Object> objects, const FacetView& view,
                                    FacetMemory& memory, FacetTargets& targets) const {
  memory.rays.clear();
  targets.facets.clear();
  targets.tiles.clear();
  targets.cells.clear();
  gather_facets(probes, objects, view, memory.facets, targets);
  double sum = 0.0;
  for (const FacetMemory::Facet& facet : memory.facets) sum += std::max(1.0, facet.wanted);
  const auto most = settings_.most_rays / kMostToFacets;  // whole rays
  const double share = std::min(1.0, static_cast<double>(most) / std::max(1.0, sum));
  std::optional<Towards> towards;
  std::size_t of = objects.size();
  for (const FacetMemory::Facet& facet : memory.facets) {
    if (facet.object != of) of = facet.object, towards = Towards::make(view, objects[of].box_enu_m);
    const double wanted = share * facet.wanted;
    const auto random = stream_.bits(kPlaces, facet.target.facet);
    if (wanted < 1.0 && 0x1p-32 * random[0] >= wanted) continue;
    const auto count = static_cast<std::uint32_t>(std::ceil(wanted));
    FacetTargets::Facet target = facet.target;
    target.area_m2 /= static_cast<float>(wanted < 1.0 ? wanted : static_cast<double>(count));
    for (std::uint32_t k = 0; k < count; ++k) {
      const Vec3 direction = (*towards)(place_on(facet.corners_enu_m, random[1], k));
      if (!holds(probes, direction)) continue;
      memory.rays.push_back({direction.normalized().cast<float>(), 0.0F});
      targets.facets.push_back(target);
    }
  }
}

void RayDistribution::settle(const Plan& plan, Batch& batch) {
  const FacetTargets& targets = plan.to_facets_;
  Rays& rays = batch.rays;
  Hits& hits = batch.hits;
  if (rays.size() != hits.size()) throw std::invalid_argument("there must be one hit per ray");
  if (targets.tiles.empty()) return;
  const std::size_t spread = std::min(rays.size(), plan.spread_ - std::min(plan.spread_, batch.first_));
  const auto facet_hit = [&](std::size_t i, const terrain::Tile& tile) {
    return facet_at(tile, hits.position_enu_m[i]);
  };
  for (std::size_t i = 0; i < spread; ++i) {
    const FacetTargets::Tile* of = tile_of(targets, hits.tile[i], hits.facet_m[i]);
    if (of && targets.cells[of->first_cell + facet_hit(i, *of->tile) / 2]) hits.set(i, Hit{});
  }
  for (std::size_t i = spread; i < rays.size(); ++i) {
    const FacetTargets::Facet& target = targets.facets[batch.first_ + i - plan.spread_];
    const FacetTargets::Tile* of = tile_of(targets, hits.tile[i], hits.facet_m[i]);
    const bool counts =
        of && hits.tile[i] == target.tile && facet_hit(i, *of->tile) == target.facet && hits.tube_m2[i] > 0.0F;
    rays.solid_angle_sr[i] = counts ? target.area_m2 * hits.sin_grazing[i] / hits.tube_m2[i] : 0.0F;
    if (!counts) hits.set(i, Hit{});
  }
}

}  // namespace ensonify::trace
