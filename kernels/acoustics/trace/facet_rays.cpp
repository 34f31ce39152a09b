#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "kernels/acoustics/trace/ray_distribution.h"
#include "kernels/acoustics/trace/towards.h"
#include "kernels/water/refraction/eigenray.h"

namespace ensonify::trace {
namespace {

using frames::Vec2;
using frames::Vec3;

constexpr std::size_t kMostToFacets = 4;  // of all rays one in so many
constexpr std::size_t kObjectsPerTask = 8;
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
                                    FacetMemory& memory, FacetTargets& targets) const {
  const std::size_t tasks = (objects.size() + kObjectsPerTask - 1) / kObjectsPerTask;
  if (memory.found.size() < tasks) memory.found.resize(tasks);
  tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
    FacetMemory::Found& found = memory.found[task];
    found.facets.clear();
    found.objects.clear();
    const std::size_t end = std::min(objects.size(), (task + 1) * kObjectsPerTask);
    for (std::size_t o = task * kObjectsPerTask; o < end; ++o) {
      if (add_facets(probes, objects[o], o, view, found.facets)) found.objects.push_back(o);
    }
  });
  memory.facets.clear();
  for (std::size_t task = 0; task < tasks; ++task) {  // in their order, however many threads there were
    const FacetMemory::Found& found = memory.found[task];
    for (const std::size_t o : found.objects) take(objects[o], targets);
    memory.facets.insert(memory.facets.end(), found.facets.begin(), found.facets.end());
  }
  std::ranges::sort(targets.tiles, {}, &FacetTargets::Tile::number);
}

/// Those of one object that need rays; false where it is left to the other rays.
bool RayDistribution::add_facets(const Probes& probes, const Object& object, std::size_t number, const FacetView& view,
                                 std::vector<FacetMemory::Facet>& facets) const {
  const double half_m = 0.5 * object.box_enu_m.diagonal().norm();
  const Vec3 off = view.head.enu_from_head.conjugate() * (object.box_enu_m.center() - view.head.position_enu_m);
  const double away_m = off.norm(),
               radius_m = half_m + (view.refracted != nullptr ? kMostRefraction_rad * away_m : 0.0);
  if (away_m - half_m > view.max_range_m || half_m > kWidest * away_m || !touches(probes, off, radius_m)) return false;
  const auto towards = Towards::make(view, object.box_enu_m);
  if (!towards) return false;
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
                          number,
                          wanted});
      }
    }
  }
  return true;
}

void RayDistribution::aim_at_facets(const Probes& probes, std::span<const Object> objects, const FacetView& view,
                                    FacetMemory& memory, FacetTargets& targets) const {
  memory.rays.clear();
  targets.facets.clear();
  targets.tiles.clear();
  targets.cells.clear();
  gather_facets(probes, objects, view, memory, targets);
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
  const std::size_t spread = std::min(rays.size(), plan.spread_ - std::min(plan.spread_, batch.first_));
  // Of the batch's rays those to tiles' facets come after the spread ones, and those to bodies last.
  const std::size_t before_bodies = plan.spread_ + targets.facets.size();
  const std::size_t to_bodies = std::min(rays.size(), before_bodies - std::min(before_bodies, batch.first_));
  const std::size_t first_body = batch.first_ + to_bodies - std::min(batch.first_ + to_bodies, before_bodies);
  batch.to_bodies = std::span(targets.body_pieces).subspan(first_body, rays.size() - to_bodies);
  settle_body_rays(targets, spread, batch);
  if (targets.tiles.empty()) return;
  const auto facet_hit = [&](std::size_t i, const terrain::Tile& tile) {
    return facet_at(tile, hits.position_enu_m[i]);
  };
  for (std::size_t i = 0; i < spread; ++i) {
    const FacetTargets::Tile* of = tile_of(targets, hits.tile[i], hits.facet_m[i]);
    if (of && targets.cells[of->first_cell + facet_hit(i, *of->tile) / 2]) hits.set(i, Hit{});
  }
  for (std::size_t i = spread; i < to_bodies; ++i) {
    const FacetTargets::Facet& target = targets.facets[batch.first_ + i - plan.spread_];
    const FacetTargets::Tile* of = tile_of(targets, hits.tile[i], hits.facet_m[i]);
    const bool counts =
        of && hits.tile[i] == target.tile && facet_hit(i, *of->tile) == target.facet && hits.tube_m2[i] > 0.0F;
    rays.solid_angle_sr[i] = counts ? target.area_m2 * hits.sin_grazing[i] / hits.tube_m2[i] : 0.0F;
    if (!counts) hits.set(i, Hit{});
  }
}

}  // namespace ensonify::trace
