#include <tbb/global_control.h>
#include <tbb/parallel_for_each.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <iterator>

#include "kernels/acoustics/trace/scene_impl.h"

namespace ensonify::trace {
namespace {

/// Pings for which a block at full detail is kept that no mesh uses.
constexpr std::uint64_t kFinePings = 1;

/// Blocks are kept for later as long as no more than one in so many of the tiles' triangles is held.
constexpr std::size_t kShareHeld = 50;

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
  const auto choose_in = [&](auto& tile) {
    Entry& entry = tile.second;
    const lod::Hierarchy& hierarchy = entry.ground->hierarchy;
    is_small(entry.ground->tile) ? entry.cover.choose_all(hierarchy) : entry.cover.choose(hierarchy, views);
  };
  tbb::parallel_invoke([&] { tbb::parallel_for_each(irregular, [&](auto& one) { one.second.choose(views); }); },
                       [&] { tbb::parallel_for_each(tiles, choose_in); });
  show();
}

/// Makes the mesh that the covers say. What is out of view is built when a ray comes to it, which is hardly ever.
void Scene::Impl::show() {
  ++adaptations;
  use(wanted());
  std::vector<std::shared_ptr<const Part>> shown;
  std::vector<const Part*> in_view;
  for (const CachedPart& cached : parts) {
    if (cached.used != adaptations) continue;
    shown.push_back(cached.part);
    if (is_in_view(cached.key.leaf)) in_view.push_back(cached.part.get());
  }
  for (auto& [number, one] : irregular) {
    const auto pieces = one.show(device, origin_enu_m);
    shown.insert(shown.end(), pieces.begin(), pieces.end());
  }
  std::vector<ShownBody> shown_bodies;
  Contributors contributors;
  for (auto& [number, one] : bodies) {
    if (one.shown.body->absent) continue;
    const auto pieces = one.triangles.show(device, origin_enu_m);
    shown.insert(shown.end(), pieces.begin(), pieces.end());
    shown_bodies.push_back(one.shown);
    const Body& body = *one.shown.body;
    contributors.set_body(number, body.instance, body.label_class, body.sediment);
  }
  std::shared_ptr<const Mesh::Content> content;
  const auto make = [&] {
    std::vector<std::shared_ptr<const Ground>> grounds;
    for (const auto& [key, entry] : tiles) {
      if (!entry.objects.empty()) grounds.push_back(entry.ground);
    }
    content = std::shared_ptr<const Mesh::Content>(new Mesh::Content{origin_enu_m, PartTree(device, std::move(shown)),
                                                                     extents(), objects, std::move(grounds),
                                                                     std::move(shown_bodies), std::move(contributors)});
  };
  tbb::parallel_invoke(make, [&] { tbb::parallel_for_each(in_view, [](const Part* part) { part->scene(); }); });
  mesh.content_ = std::move(content);
  forget();
  stale = false;
}

std::vector<PartKey> Scene::Impl::wanted() const {
  std::vector<std::pair<const terrain::TileKey*, std::vector<PartKey>>> by_tile;
  for (const auto& [key, entry] : tiles) by_tile.push_back({&key, {}});
  tbb::parallel_for_each(by_tile, [&](auto& one) {
    auto& [key, keys] = one;
    const lod::Cover& cover = tiles.at(*key).cover;
    const lod::Neighbours neighbours = neighbours_of(*key);
    std::vector<lod::Leaf> leaves = cover.leaves();
    std::ranges::sort(leaves);
    keys.reserve(leaves.size());
    for (const lod::Leaf& leaf : leaves) keys.push_back({*key, leaf, lod::rim_of(leaf, cover, neighbours)});
  });
  std::vector<PartKey> all;
  for (const auto& [key, keys] : by_tile) all.insert(all.end(), keys.begin(), keys.end());
  return all;
}

void Scene::Impl::use(const std::vector<PartKey>& keys) {
  std::vector<CachedPart> all;
  all.reserve(parts.size() + keys.size());
  auto old = parts.begin();
  for (const PartKey& key : keys) {
    while (old != parts.end() && old->key < key) all.push_back(std::move(*old++));
    if (old != parts.end() && old->key == key) {
      all.push_back(std::move(*old++));
    } else {
      const Entry& entry = tiles.at(key.tile);
      const Shown shown{entry.ground, entry.number, key.leaf, key.rim};
      all.push_back({key, std::make_shared<BlockPart>(device, shown, origin_enu_m)});
    }
    all.back().used = adaptations;
  }
  std::move(old, parts.end(), std::back_inserter(all));
  parts = std::move(all);
}

/// A vehicle that rolls comes back to blocks at full detail soon or never. Coarse ones come back when the main lobe has
/// passed: they stay as long as there is room, fine ones first, then the last used longest. What no ray has come to
/// costs nothing to make.
void Scene::Impl::forget() {
  const auto adaptations_per_ping = static_cast<std::uint64_t>(detail.adaptations_per_ping);
  const auto age = [&](const CachedPart& cached) {
    return (adaptations - cached.used) / adaptations_per_ping;
  };  // in pings
  std::size_t paged = 0, held = 0, fine = 0;
  for (const auto& [key, entry] : tiles)
    paged += 2 * static_cast<std::size_t>(entry.ground->tile.columns - 1) *
             static_cast<std::size_t>(entry.ground->tile.rows - 1);
  std::map<std::uint64_t, std::size_t> spare;  // triangles of coarse blocks by age
  for (CachedPart& cached : parts) {
    if (cached.triangles == 0) cached.triangles = cached.part->triangles();
    (age(cached) == 0 ? held : cached.key.leaf.level == 0 ? fine : spare[age(cached)]) += cached.triangles;
  }
  const bool fine_stay = (held + fine) * kShareHeld <= paged;
  if (fine_stay) held += fine;
  std::uint64_t oldest = 0;
  for (const auto& [pings, triangles] : spare) {
    held += triangles;
    if (held * kShareHeld > paged) break;
    oldest = pings;
  }
  std::vector<std::shared_ptr<BlockPart>> given_up;
  std::erase_if(parts, [&](CachedPart& cached) {
    const std::uint64_t pings = cached.key.leaf.level > 0 ? oldest : fine_stay ? kFinePings : 0;
    if (age(cached) == 0 || (cached.triangles > 0 && age(cached) <= pings)) return false;
    given_up.push_back(std::move(cached.part));
    return true;
  });
  tbb::parallel_for_each(given_up, [](std::shared_ptr<BlockPart>& part) { part.reset(); });
}

/// A block is as coarse as a view asks for, or coarser where none intersects it.
bool Scene::Impl::is_in_view(const lod::Leaf& leaf) const {
  return !detail.enabled || std::ranges::any_of(views, [&](const lod::View& view) { return leaf.level <= view.level; });
}

lod::Neighbours Scene::Impl::neighbours_of(const terrain::TileKey& key) const {
  const terrain::Tile& tile = tiles.at(key).ground->tile;
  const auto beside = [&](std::int32_t east, std::int32_t north) -> const lod::Cover* {
    const auto other = tiles.find({key.east + east, key.north + north});
    if (other == tiles.end()) return nullptr;
    const bool before = east + north < 0;
    const terrain::Tile& neighbour = other->second.ground->tile;
    return continues(before ? neighbour : tile, before ? tile : neighbour, east != 0) ? &other->second.cover : nullptr;
  };
  return {beside(-1, 0), beside(1, 0), beside(0, -1), beside(0, 1)};
}

void Scene::Impl::change() {
  stale = true;
  mesh = {};
}

void Scene::Impl::change(const terrain::TileKey& key) {
  change();
  std::erase_if(parts, [&](const auto& cached) { return cached.key.tile == key; });
}

void Scene::Impl::show_all() {
  if (detail.enabled) return;
  for (auto& [key, entry] : tiles) entry.cover.choose_all(entry.ground->hierarchy);
  for (auto& [number, one] : irregular) one.choose_all();
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  show();  // a tree of many grids is always built the same way
}

}  // namespace ensonify::trace
