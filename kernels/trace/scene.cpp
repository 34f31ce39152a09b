#include "kernels/trace/scene.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "kernels/trace/packet.h"

namespace ensonify::trace {
namespace {

using frames::Vec2;
using frames::Vec3;

constexpr std::int32_t kBlockCells = 64;   // cells per side of a grid primitive
constexpr std::int32_t kObjectCells = 16;  // of a box around what stands among holes

/// One instruction set everywhere that results must match. No number of threads: Embree would hold the whole process's
/// TBB to it.
Device new_device() {
  Device device(rtcNewDevice("isa=avx2,set_affinity=0"));
  if (!device) throw std::runtime_error("Embree cannot start (it needs a processor with AVX2)");
  return device;
}

bool whole_cell(const terrain::Tile& tile, std::int32_t column, std::int32_t row) {
  for (const auto& [c, r] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
    if (!std::isfinite(tile.height_m[tile.post(column + c, row + r)])) return false;
  }
  return true;
}

/// A box around the whole cells of [column, column + width) x [row, row + height), within the tile; none without such.
/// It is there only where a cell in or around the block is a hole, or where `all` of them are wanted.
void add_object(const terrain::Tile& tile, std::int32_t column, std::int32_t row, std::int32_t side, bool all,
                std::vector<Object>& objects) {
  Object object{{}, static_cast<float>(tile.spacing_m)};
  bool holes = all;
  for (std::int32_t r = std::max(row - 1, 0); r < std::min(row + side + 1, tile.rows - 1); ++r) {
    for (std::int32_t c = std::max(column - 1, 0); c < std::min(column + side + 1, tile.columns - 1); ++c) {
      const bool inside = row <= r && r < row + side && column <= c && c < column + side;
      if (!whole_cell(tile, c, r)) {
        holes = true;
      } else if (inside) {
        for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
          object.box_enu_m.extend(tile.position_enu_m(c + x, r + y));
        }
      }
    }
  }
  if (holes && !object.box_enu_m.isEmpty()) objects.push_back(object);
}

std::vector<Object> objects_of(const terrain::Tile& tile) {
  std::vector<Object> objects;
  if (std::max(tile.columns, tile.rows) <= kBlockCells) {
    add_object(tile, 0, 0, kBlockCells, true, objects);
  } else if (!std::all_of(tile.height_m.begin(), tile.height_m.end(), [](float z) { return std::isfinite(z); })) {
    for (std::int32_t row = 0; row < tile.rows - 1; row += kObjectCells) {
      for (std::int32_t column = 0; column < tile.columns - 1; column += kObjectCells) {
        add_object(tile, column, row, kObjectCells, false, objects);
      }
    }
  }
  return objects;
}

/// Cells [column, column + width) x [row, row + height) without a hole become one grid; else each whole cell becomes
/// one.
void add_block(const terrain::Tile& tile, std::int32_t column, std::int32_t row, std::vector<RTCGrid>& grids) {
  const std::int32_t width = std::min(kBlockCells, tile.columns - 1 - column);
  const std::int32_t height = std::min(kBlockCells, tile.rows - 1 - row);
  const auto whole = [&](std::int32_t c, std::int32_t r, std::int32_t w, std::int32_t h) {
    for (std::int32_t y = r; y <= r + h; ++y) {
      for (std::int32_t x = c; x <= c + w; ++x) {
        if (!std::isfinite(tile.height_m[tile.post(x, y)])) return false;
      }
    }
    return true;
  };
  const auto add = [&](std::int32_t c, std::int32_t r, std::int32_t w, std::int32_t h) {
    grids.push_back({static_cast<unsigned>(tile.post(c, r)), static_cast<unsigned>(tile.columns),
                     static_cast<unsigned short>(w + 1), static_cast<unsigned short>(h + 1)});
  };
  if (whole(column, row, width, height)) return add(column, row, width, height);
  for (std::int32_t r = row; r < row + height; ++r) {
    for (std::int32_t c = column; c < column + width; ++c) {
      if (whole_cell(tile, c, r)) add(c, r, 1, 1);
    }
  }
}

EmbreeScene scene_of(const Device& device, const terrain::Tile& tile, const Vec2& origin_enu_m) {
  std::vector<RTCGrid> grids;
  for (std::int32_t row = 0; row < tile.rows - 1; row += kBlockCells) {
    for (std::int32_t column = 0; column < tile.columns - 1; column += kBlockCells) add_block(tile, column, row, grids);
  }
  EmbreeScene scene(rtcNewScene(device.get()));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  if (!grids.empty()) {
    RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_GRID);
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), tile.height_m.size()));
    for (std::int32_t row = 0; row < tile.rows; ++row) {
      for (std::int32_t column = 0; column < tile.columns; ++column, vertex += 3) {
        const Vec3 post = tile.position_enu_m(column, row);
        vertex[0] = static_cast<float>(post.x() - origin_enu_m.x());
        vertex[1] = static_cast<float>(post.y() - origin_enu_m.y());
        vertex[2] = static_cast<float>(post.z());
      }
    }
    void* grid =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), grids.size());
    std::copy(grids.begin(), grids.end(), static_cast<RTCGrid*>(grid));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
  }
  {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    rtcCommitScene(scene.get());  // a tree is always built the same way
  }
  if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE) throw std::runtime_error("Embree could not build a tile");
  return scene;
}

Heights heights_of(const terrain::Tile& tile) {
  Heights heights{.lowest_m = std::numeric_limits<double>::infinity(),
                  .highest_m = -std::numeric_limits<double>::infinity()};
  for (const float post : tile.height_m) {
    if (!std::isfinite(post)) continue;
    heights.lowest_m = std::min(heights.lowest_m, static_cast<double>(post));
    heights.highest_m = std::max(heights.highest_m, static_cast<double>(post));
  }
  return heights;
}

bool within(const terrain::Tile& tile, const Vec2& place, double radius_m) {
  const Vec2 corner = tile.origin_enu_m + tile.spacing_m * Vec2(tile.columns - 1, tile.rows - 1);
  const Vec2 nearest = place.cwiseMax(tile.origin_enu_m).cwiseMin(corner);
  return (nearest - place).norm() <= radius_m;
}

Hit hit_of(const Packet& packet, std::size_t lane, const terrain::Tile& tile, const Vec3& head_enu_m,
           float slowness_spm) {
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
  hit.facet_m = static_cast<float>(tile.spacing_m);
  hit.sediment = terrain::sediment_at(tile, hit.position_enu_m.head<2>());
  return hit;
}

}  // namespace

Scene::Scene(const Vec2& origin_enu_m) : impl_(std::make_unique<Impl>()) {
  impl_->device = new_device();
  impl_->origin_enu_m = origin_enu_m;
}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

void Scene::insert(const terrain::TileKey& key, const terrain::Tile& tile) {
  if (const auto fault = terrain::fault_of(tile)) throw std::invalid_argument(*fault);
  impl_->tiles.insert_or_assign(
      key, Entry{tile, scene_of(impl_->device, tile, impl_->origin_enu_m), heights_of(tile), objects_of(tile)});
  impl_->gather_objects();
}

bool Scene::remove(const terrain::TileKey& key) {
  const bool there = impl_->tiles.erase(key) > 0;
  impl_->gather_objects();
  return there;
}

void Scene::recentre(const Vec2& origin_enu_m) {
  impl_->origin_enu_m = origin_enu_m;
  for (auto& [key, entry] : impl_->tiles) entry.scene = scene_of(impl_->device, entry.tile, origin_enu_m);
}

std::span<const Object> Scene::objects() const { return impl_->objects; }
bool Scene::empty() const { return impl_->tiles.empty(); }
std::size_t Scene::size() const { return impl_->tiles.size(); }
bool Scene::contains(const terrain::TileKey& key) const { return impl_->tiles.contains(key); }
const Vec2& Scene::origin_enu_m() const { return impl_->origin_enu_m; }

std::optional<Heights> Scene::heights_near(const Vec2& place_enu_m, double radius_m) const {
  std::optional<Heights> all;
  for (const auto& [key, entry] : impl_->tiles) {
    if (!within(entry.tile, place_enu_m, radius_m) || !(entry.heights.lowest_m <= entry.heights.highest_m)) continue;
    if (!all) all = entry.heights;
    all->lowest_m = std::min(all->lowest_m, entry.heights.lowest_m);
    all->highest_m = std::max(all->highest_m, entry.heights.highest_m);
  }
  return all;
}

void Scene::trace(const frames::HeadPose& head, std::span<const Ray> rays, float max_range_m, std::vector<Hit>& hits,
                  double sound_speed_mps) const {
  const auto slowness_spm = static_cast<float>(1.0 / sound_speed_mps);
  hits.resize(rays.size());
  const Eigen::Matrix3d enu_from_head = head.enu_from_head.toRotationMatrix();
  const Vec3 start(head.position_enu_m.x() - impl_->origin_enu_m.x(), head.position_enu_m.y() - impl_->origin_enu_m.y(),
                   head.position_enu_m.z());
  const std::size_t packets = (rays.size() + kPacket - 1) / kPacket;
  const auto trace_packet = [&](std::size_t index) {
    const std::size_t first = index * kPacket;
    const std::size_t count = std::min(kPacket, rays.size() - first);
    Packet packet;
    for (std::size_t lane = 0; lane < count; ++lane) {
      packet.set(lane, start, enu_from_head * rays[first + lane].direction_head.cast<double>(), max_range_m);
    }
    for (std::size_t lane = count; lane < kPacket; ++lane) packet.switch_off(lane);
    packet.intersect(impl_->tiles);
    for (std::size_t lane = 0; lane < count; ++lane) {
      hits[first + lane] =
          packet.met[lane] ? hit_of(packet, lane, *packet.met[lane], head.position_enu_m, slowness_spm) : Hit{};
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
