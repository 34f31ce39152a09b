#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_for_each.h>

#include <algorithm>
#include <cmath>

#include "kernels/trace/scene_impl.h"

namespace ensonify::trace {
namespace {

/// Pings for which a part is kept that no mesh has used: a vehicle that rolls comes back to small ones.
std::uint64_t kept(std::int32_t level) { return level == 0 ? 1 : 4; }

/// Whether b continues a's lattice to the east or to the north, with the same posts on the edge between.
bool continues(const terrain::Tile& a, const terrain::Tile& b, bool to_east) {
  const terrain::Vec2 step =
      to_east ? terrain::Vec2((a.columns - 1) * a.spacing_m, 0.0) : terrain::Vec2(0.0, (a.rows - 1) * a.spacing_m);
  const bool same_edge = to_east ? a.rows == b.rows : a.columns == b.columns;
  return same_edge && a.spacing_m == b.spacing_m &&
         (a.origin_enu_m + step - b.origin_enu_m).norm() < 1e-3 * a.spacing_m;
}

}  // namespace

void Scene::Impl::adapt(std::span<const lod::View> wanted) {
  if (!stale && std::equal(wanted.begin(), wanted.end(), views.begin(), views.end())) return;
  views.assign(wanted.begin(), wanted.end());
  tbb::parallel_for_each(tiles, [&](auto& tile) {
    Entry& entry = tile.second;
    is_small(entry.tile) ? entry.cover.choose_all(entry.hierarchy) : entry.cover.choose(entry.hierarchy, views);
  });
  show();
}

/// Makes the mesh that the covers say.
void Scene::Impl::show() {
  std::vector<PartKey> keys;
  for (const auto& [key, entry] : tiles) {
    const lod::Neighbours neighbours = neighbours_of(key);
    for (const lod::Leaf& leaf : entry.cover.leaves()) {
      keys.push_back({key, leaf, lod::rim_of(leaf, entry.cover, neighbours)});
    }
  }
  ++adaptations;
  mesh.assign(device, use(keys));
  std::erase_if(parts, [&](const auto& part) {
    const auto& [key, cached] = part;
    return cached.used + kept(key.leaf.level) * static_cast<std::uint64_t>(detail.looks) < adaptations;
  });
  check(device, "Embree could not build the seabed");
  stale = false;
}

/// The parts of a mesh, in order; those that are missing are built, each by one thread.
std::vector<const Part*> Scene::Impl::use(const std::vector<PartKey>& keys) {
  std::vector<CachedPart*> all;
  std::vector<std::size_t> missing;
  for (const PartKey& key : keys) {
    CachedPart& cached = parts[key];
    if (cached.used == 0) missing.push_back(all.size());
    cached.used = adaptations;
    all.push_back(&cached);
  }
  tbb::parallel_for(std::size_t{0}, missing.size(), [&](std::size_t i) {
    const PartKey& key = keys[missing[i]];
    const Entry& entry = tiles.at(key.tile);
    Part& part = all[missing[i]]->part;
    part = part_of(device, lod::patch_of(entry.tile, entry.hierarchy, key.leaf, key.rim, origin_enu_m));
    part.tile = &entry.tile;
    part.number = entry.number;
    part.facet_m = static_cast<float>(std::ldexp(entry.tile.spacing_m, key.leaf.level));
  });
  std::vector<const Part*> present;
  for (const CachedPart* cached : all) {
    if (cached->part.scene) present.push_back(&cached->part);
  }
  return present;
}

lod::Neighbours Scene::Impl::neighbours_of(const terrain::TileKey& key) const {
  const terrain::Tile& tile = tiles.at(key).tile;
  const auto beside = [&](std::int32_t east, std::int32_t north) -> const lod::Cover* {
    const auto other = tiles.find({key.east + east, key.north + north});
    if (other == tiles.end()) return nullptr;
    const bool before = east + north < 0;
    const terrain::Tile& neighbour = other->second.tile;
    return continues(before ? neighbour : tile, before ? tile : neighbour, east != 0) ? &other->second.cover : nullptr;
  };
  return {beside(-1, 0), beside(1, 0), beside(0, -1), beside(0, 1)};
}

void Scene::Impl::change(const terrain::TileKey& key) {
  stale = true;
  mesh.assign(device, {});
  std::erase_if(parts, [&](const auto& cached) { return cached.first.tile == key; });
}

void Scene::Impl::show_all() {
  if (detail.enabled) return;
  for (auto& [key, entry] : tiles) entry.cover.choose_all(entry.hierarchy);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  show();  // a tree of many grids is always built the same way
}

}  // namespace ensonify::trace
