#include "kernels/acoustics/trace/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "kernels/acoustics/trace/scene_impl.h"

namespace ensonify::trace {
namespace {

using frames::Vec2;

constexpr double kLattice_m = 2048.0;  // of Embree's origins: none of a head's tiles is 4 km away

Heights heights_of(const lod::Hierarchy& tile) {
  Heights heights{.lowest_m = std::numeric_limits<double>::infinity(),
                  .highest_m = -std::numeric_limits<double>::infinity()};
  for (lod::Block block{.size = lod::kLargest}; block.row < tile.rows(lod::kLargest); ++block.row) {
    for (block.column = 0; block.column < tile.columns(lod::kLargest); ++block.column) {
      if (tile.empty(block)) continue;
      const auto [low, high] = tile.box_enu_m(block);
      heights.lowest_m = std::min(heights.lowest_m, low.z());
      heights.highest_m = std::max(heights.highest_m, high.z());
    }
  }
  return heights;
}

bool within(const Vec2& south_west, const Vec2& north_east, const Vec2& place, double radius_m) {
  const Vec2 nearest = place.cwiseMax(south_west).cwiseMin(north_east);
  return (nearest - place).norm() <= radius_m;
}

}  // namespace

Scene::Scene(const Vec2& origin_enu_m, const LevelOfDetail& detail) : impl_(std::make_unique<Impl>()) {
  impl_->device = new_device();
  impl_->origin_enu_m = origin_enu_m;
  impl_->detail = detail;
}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

void Scene::insert(const terrain::TileKey& key, terrain::Tile tile) {
  if (const auto fault = terrain::fault_of(tile)) throw std::invalid_argument(*fault);
  impl_->change(key);
  lod::Hierarchy hierarchy(tile);
  auto ground = std::make_shared<const Ground>(Ground{std::move(tile), std::move(hierarchy)});
  const Heights heights = heights_of(ground->hierarchy);
  std::vector<Object> objects = objects_of(ground->tile);
  impl_->tiles.insert_or_assign(key, Entry{++impl_->inserted, std::move(ground), heights, std::move(objects), {}});
  impl_->gather_objects();
}

bool Scene::remove(const terrain::TileKey& key) {
  impl_->change(key);
  const bool removed = impl_->tiles.erase(key) > 0;
  impl_->gather_objects();
  return removed;
}

void Scene::insert(std::int64_t number, IrregularMesh mesh) {
  if (const std::string fault = progressive::fault_of(mesh.hierarchy); !fault.empty())
    throw std::invalid_argument("irregular mesh: " + fault);
  impl_->change();
  impl_->irregular.insert_or_assign(
      number, Irregular(std::move(mesh.hierarchy), ++impl_->inserted, sediment_contributor(mesh.sediment)));
}

bool Scene::remove(std::int64_t number) {
  impl_->change();
  const bool removed = impl_->irregular.erase(number) > 0;
  return removed;
}

void Scene::insert_body(std::uint32_t number, Body body) {
  const solids::Surface& surface = body.surface;
  if (const std::string fault = progressive::fault_of(surface.mesh); !fault.empty())
    throw std::invalid_argument("body: " + fault);
  if (!surface.bulge_m.empty() && surface.bulge_m.size() != surface.mesh.triangle.size())
    throw std::invalid_argument("body: there must be bulges of each triangle, or none");
  impl_->change();
  progressive::Hierarchy whole = progressive::hierarchy_of(surface.mesh, {});
  ShownBody shown{std::make_shared<const Body>(std::move(body)), ++impl_->inserted, body_contributor(number), {}};
  Irregular triangles(std::move(whole), shown.tile, shown.contributor);
  triangles.choose_all();
  shown.box_enu_m = triangles.box_enu_m();
  impl_->bodies.insert_or_assign(number, BodyEntry{std::move(shown), std::move(triangles)});
}

bool Scene::remove_body(std::uint32_t number) {
  impl_->change();
  const bool removed = impl_->bodies.erase(number) > 0;
  return removed;
}

void Scene::centre_near(const Vec2& place_enu_m) { impl_->centre_near(place_enu_m); }

void Scene::Impl::centre_near(const Vec2& place_enu_m) {
  const Vec2 nearest_enu_m = kLattice_m * (place_enu_m / kLattice_m).array().round().matrix();
  if (nearest_enu_m == origin_enu_m) return;
  origin_enu_m = nearest_enu_m;
  change();
  for (const auto& [key, entry] : tiles) change(key);
  for (auto& [number, one] : irregular) one.forget();
  for (auto& [number, one] : bodies) one.triangles.forget();
}

Mesh Scene::adapted(std::span<const lod::View> views) const {
  const std::lock_guard lock(impl_->adapting);
  if (!views.empty()) impl_->centre_near(views.front().frustum.apex_enu_m.head<2>());
  if (impl_->detail.enabled) impl_->adapt(views);
  else if (impl_->stale) impl_->show_all();
  Mesh mesh = impl_->mesh;
  mesh.facet_mean_square_slope_ = impl_->facet_mean_square_slope;
  return mesh;
}

std::span<const Object> Scene::objects() const { return *impl_->objects; }

void Scene::set_facet_mean_square_slope(std::span<const double> by_class) {
  impl_->facet_mean_square_slope = std::make_shared<const std::vector<double>>(by_class.begin(), by_class.end());
}

const LevelOfDetail& Scene::detail() const { return impl_->detail; }
bool Scene::empty() const { return impl_->tiles.empty(); }
std::size_t Scene::size() const { return impl_->tiles.size(); }
bool Scene::contains(const terrain::TileKey& key) const { return impl_->tiles.contains(key); }
const Vec2& Scene::origin_enu_m() const { return impl_->origin_enu_m; }

std::size_t Scene::triangles() const {
  std::size_t sum = 0;
  for (const CachedPart& cached : impl_->parts) sum += cached.part->triangles();
  for (const auto& [number, one] : impl_->irregular) sum += one.triangles();
  for (const auto& [number, one] : impl_->bodies) sum += one.triangles.triangles();
  return sum;
}

std::optional<double> Scene::height_m(const Vec2& place_enu_m) const {
  for (const auto& [key, entry] : impl_->tiles) {
    if (const auto height = terrain::height_m(entry.ground->tile, place_enu_m)) return height;
  }
  return std::nullopt;
}

std::optional<Heights> Scene::heights_near(const Vec2& place_enu_m, double radius_m) const {
  return trace::heights_near(impl_->extents(), place_enu_m, radius_m);
}

std::vector<Extent> Scene::Impl::extents() const {
  std::vector<Extent> all;
  for (const auto& [key, entry] : tiles) {
    const terrain::Tile& tile = entry.ground->tile;
    all.push_back(
        {tile.origin_enu_m, tile.origin_enu_m + tile.spacing_m * Vec2(tile.columns - 1, tile.rows - 1), entry.heights});
  }
  const auto add = [&](const Eigen::AlignedBox3d& box) {
    if (!box.isEmpty()) all.push_back({box.min().head<2>(), box.max().head<2>(), {box.min().z(), box.max().z()}});
  };
  for (const auto& [number, one] : irregular) add(one.box_enu_m());
  for (const auto& [number, one] : bodies) add(one.shown.box_enu_m);
  return all;
}

std::optional<Heights> heights_near(std::span<const Extent> extents, const Vec2& place_enu_m, double radius_m) {
  std::optional<Heights> all;
  for (const auto& [south_west, north_east, heights] : extents) {
    if (!within(south_west, north_east, place_enu_m, radius_m) || !(heights.lowest_m <= heights.highest_m)) continue;
    if (!all) all = heights;
    all->lowest_m = std::min(all->lowest_m, heights.lowest_m);
    all->highest_m = std::max(all->highest_m, heights.highest_m);
  }
  return all;
}

}  // namespace ensonify::trace
