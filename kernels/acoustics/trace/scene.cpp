#include "kernels/acoustics/trace/scene.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "kernels/acoustics/trace/packet.h"
#include "kernels/acoustics/trace/scene_impl.h"

namespace ensonify::trace {
namespace {

using frames::Vec2;
using frames::Vec3;

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

Hit hit_of(const Packet& packet, std::size_t lane, const Vec3& head_enu_m, float slowness_spm) {
  const Part& part = *packet.part_hit[lane];
  const Vec3 direction(packet.rays.ray.dir_x[lane], packet.rays.ray.dir_y[lane], packet.rays.ray.dir_z[lane]);
  const Vec3 normal = packet.normal(lane);
  const double cosine = normal.dot(direction);
  Hit hit;
  hit.position_enu_m = head_enu_m + static_cast<double>(packet.rays.ray.tfar[lane]) * direction;
  hit.normal_enu = (cosine > 0.0 ? Vec3(-normal) : normal).cast<float>();
  hit.arrival_enu = direction.cast<float>();
  hit.range_m = packet.rays.ray.tfar[lane];
  hit.travel_time_s = hit.range_m * slowness_spm;
  hit.path_length_m = hit.range_m;
  hit.tube_m2 = hit.range_m * hit.range_m;
  hit.sin_grazing = static_cast<float>(std::min(1.0, std::abs(cosine)));
  hit.facet_m = part.facet_m();
  hit.tile = part.number();
  hit.contributor = sediment_contributor(part.sediment_at(hit.position_enu_m.head<2>()));
  return hit;
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
  const Heights heights = heights_of(hierarchy);
  std::vector<Object> objects = objects_of(tile);
  impl_->tiles.insert_or_assign(
      key, Entry{++impl_->inserted, std::move(tile), std::move(hierarchy), heights, std::move(objects), {}});
  impl_->gather_objects();
  impl_->show_all();
}

bool Scene::remove(const terrain::TileKey& key) {
  impl_->change(key);
  const bool removed = impl_->tiles.erase(key) > 0;
  impl_->gather_objects();
  impl_->show_all();
  return removed;
}

void Scene::insert(std::int64_t number, IrregularMesh mesh) {
  if (const std::string fault = progressive::fault_of(mesh.hierarchy); !fault.empty())
    throw std::invalid_argument("irregular mesh: " + fault);
  impl_->change();
  impl_->irregular.insert_or_assign(number, Irregular(std::move(mesh), ++impl_->inserted));
  impl_->show_all();
}

bool Scene::remove(std::int64_t number) {
  impl_->change();
  const bool removed = impl_->irregular.erase(number) > 0;
  impl_->show_all();
  return removed;
}

void Scene::centre_near(const Vec2& place_enu_m) {
  const Vec2 origin_enu_m = kLattice_m * (place_enu_m / kLattice_m).array().round().matrix();
  if (origin_enu_m == impl_->origin_enu_m) return;
  impl_->origin_enu_m = origin_enu_m;
  for (const auto& [key, entry] : impl_->tiles) impl_->change(key);
  for (auto& [number, one] : impl_->irregular) one.forget();
  impl_->show_all();
}

void Scene::adapt(std::span<const lod::View> views) {
  if (impl_->detail.enabled) impl_->adapt(views);
}

std::span<const Object> Scene::objects() const { return impl_->objects; }

void Scene::set_facet_mean_square_slope(std::span<const double> by_class) {
  impl_->facet_mean_square_slope.assign(by_class.begin(), by_class.end());
}
std::span<const double> Scene::facet_mean_square_slope() const { return impl_->facet_mean_square_slope; }

const LevelOfDetail& Scene::detail() const { return impl_->detail; }
bool Scene::empty() const { return impl_->tiles.empty(); }
std::size_t Scene::size() const { return impl_->tiles.size(); }
bool Scene::contains(const terrain::TileKey& key) const { return impl_->tiles.contains(key); }
const Vec2& Scene::origin_enu_m() const { return impl_->origin_enu_m; }

std::size_t Scene::triangles() const {
  std::size_t sum = 0;
  for (const CachedPart& cached : impl_->parts) sum += cached.part->triangles();
  for (const auto& [number, one] : impl_->irregular) sum += one.triangles();
  return sum;
}

std::optional<double> Scene::height_m(const Vec2& place_enu_m) const {
  for (const auto& [key, entry] : impl_->tiles) {
    if (const auto height = terrain::height_m(entry.tile, place_enu_m)) return height;
  }
  return std::nullopt;
}

std::optional<Heights> Scene::heights_near(const Vec2& place_enu_m, double radius_m) const {
  std::optional<Heights> all;
  const auto add = [&](const Heights& heights) {
    if (!(heights.lowest_m <= heights.highest_m)) return;
    if (!all) all = heights;
    all->lowest_m = std::min(all->lowest_m, heights.lowest_m);
    all->highest_m = std::max(all->highest_m, heights.highest_m);
  };
  for (const auto& [key, entry] : impl_->tiles) {
    const Vec2 corner =
        entry.tile.origin_enu_m + entry.tile.spacing_m * Vec2(entry.tile.columns - 1, entry.tile.rows - 1);
    if (within(entry.tile.origin_enu_m, corner, place_enu_m, radius_m)) add(entry.heights);
  }
  for (const auto& [number, one] : impl_->irregular) {
    const auto& box = one.box_enu_m();
    if (!box.isEmpty() && within(box.min().head<2>(), box.max().head<2>(), place_enu_m, radius_m))
      add({box.min().z(), box.max().z()});
  }
  return all;
}

void Scene::trace(const frames::HeadPose& head, const Rays& rays, float max_range_m, Hits& hits, double sound_speed_mps,
                  std::uint32_t behind) const {
  const auto slowness_spm = static_cast<float>(1.0 / sound_speed_mps);
  hits.make_elements(rays.size());
  const Eigen::Matrix3d enu_from_head = head.enu_from_head.toRotationMatrix();
  const Vec3 start(head.position_enu_m.x() - impl_->origin_enu_m.x(), head.position_enu_m.y() - impl_->origin_enu_m.y(),
                   head.position_enu_m.z());
  const std::size_t packets = (rays.size() + kPacket - 1) / kPacket;
  const auto trace_packet = [&](std::size_t index) {
    const std::size_t first = index * kPacket;
    const std::size_t count = std::min(kPacket, rays.size() - first);
    Packet packet;
    for (std::size_t lane = 0; lane < count; ++lane) {
      packet.set(lane, start, enu_from_head * rays.direction_head[first + lane].cast<double>(), max_range_m);
    }
    for (std::size_t lane = count; lane < kPacket; ++lane) packet.switch_off(lane);
    packet.intersect(impl_->mesh);
    if (behind != kNoise) {
      float tfar_m[kPacket];
      std::ranges::fill(tfar_m, max_range_m);
      packet.pass(impl_->mesh, behind, tfar_m, [&](std::size_t lane) {
        return hit_of(packet, lane, head.position_enu_m, slowness_spm).contributor;
      });
    }
    for (std::size_t lane = 0; lane < count; ++lane) {
      hits.set(first + lane, packet.part_hit[lane] ? hit_of(packet, lane, head.position_enu_m, slowness_spm) : Hit{});
    }
  };
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, packets, kChunk),
      [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) trace_packet(i);
      },
      tbb::simple_partitioner());
}

}  // namespace ensonify::trace
