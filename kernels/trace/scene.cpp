#include "kernels/trace/scene.h"

#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace ensonify::trace {
namespace {

using frames::Vec2;
using frames::Vec3;

constexpr std::size_t kPacket = 16;       // rays that Embree traces together
constexpr std::size_t kChunk = 32;        // packets per task: fixed, so the number of threads changes nothing
constexpr std::int32_t kBlockCells = 64;  // cells per side of a grid primitive

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, DeviceRelease>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, SceneRelease>;

/// One instruction set everywhere that results must match, and one thread so that a tree is always built the same way.
Device new_device() {
  Device device(rtcNewDevice("isa=avx2,threads=1,set_affinity=0"));
  if (!device) throw std::runtime_error("Embree cannot start (it needs a processor with AVX2)");
  return device;
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
      if (whole(c, r, 1, 1)) add(c, r, 1, 1);
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
  rtcCommitScene(scene.get());
  if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE) throw std::runtime_error("Embree could not build a tile");
  return scene;
}

struct Entry {
  terrain::Tile tile;
  EmbreeScene scene;
};

/// Rays of one packet, in Embree's frame. Lanes beyond `count` are off.
struct Packet {
  alignas(64) RTCRayHit16 rays;
  alignas(64) int on[kPacket];
};

void load(Packet& packet, std::span<const Ray> rays, const Vec3& start, const Eigen::Matrix3d& enu_from_head,
          float max_range_m) {
  for (std::size_t lane = 0; lane < kPacket; ++lane) {
    packet.on[lane] = lane < rays.size() ? -1 : 0;
    const Vec3 direction =
        lane < rays.size() ? Vec3(enu_from_head * rays[lane].direction_head.cast<double>()) : Vec3::UnitZ();
    packet.rays.ray.org_x[lane] = static_cast<float>(start.x());
    packet.rays.ray.org_y[lane] = static_cast<float>(start.y());
    packet.rays.ray.org_z[lane] = static_cast<float>(start.z());
    packet.rays.ray.dir_x[lane] = static_cast<float>(direction.x());
    packet.rays.ray.dir_y[lane] = static_cast<float>(direction.y());
    packet.rays.ray.dir_z[lane] = static_cast<float>(direction.z());
    packet.rays.ray.tnear[lane] = 0.0F;
    packet.rays.ray.tfar[lane] = max_range_m;
    packet.rays.ray.time[lane] = 0.0F;
    packet.rays.ray.mask[lane] = ~0U;
    packet.rays.ray.id[lane] = 0;
    packet.rays.ray.flags[lane] = 0;
    packet.rays.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    packet.rays.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  }
}

Hit hit_of(const Packet& packet, std::size_t lane, const terrain::Tile& tile, const Vec3& head_enu_m,
           float slowness_spm) {
  const Vec3 direction(packet.rays.ray.dir_x[lane], packet.rays.ray.dir_y[lane], packet.rays.ray.dir_z[lane]);
  const Vec3 normal =
      Vec3(packet.rays.hit.Ng_x[lane], packet.rays.hit.Ng_y[lane], packet.rays.hit.Ng_z[lane]).normalized();
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
  hit.sediment = terrain::sediment_at(tile, hit.position_enu_m.head<2>());
  return hit;
}

}  // namespace

struct Scene::Impl {
  Device device = new_device();
  Vec2 origin_enu_m;
  std::map<terrain::TileKey, Entry> tiles;
};

Scene::Scene(const Vec2& origin_enu_m) : impl_(std::make_unique<Impl>()) { impl_->origin_enu_m = origin_enu_m; }
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

void Scene::insert(const terrain::TileKey& key, const terrain::Tile& tile) {
  if (const auto fault = terrain::fault_of(tile)) throw std::invalid_argument(*fault);
  impl_->tiles.insert_or_assign(key, Entry{tile, scene_of(impl_->device, tile, impl_->origin_enu_m)});
}

bool Scene::remove(const terrain::TileKey& key) { return impl_->tiles.erase(key) > 0; }

void Scene::recentre(const Vec2& origin_enu_m) {
  impl_->origin_enu_m = origin_enu_m;
  for (auto& [key, entry] : impl_->tiles) entry.scene = scene_of(impl_->device, entry.tile, origin_enu_m);
}

bool Scene::empty() const { return impl_->tiles.empty(); }
std::size_t Scene::size() const { return impl_->tiles.size(); }
bool Scene::contains(const terrain::TileKey& key) const { return impl_->tiles.contains(key); }
const Vec2& Scene::origin_enu_m() const { return impl_->origin_enu_m; }

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
    load(packet, rays.subspan(first, count), start, enu_from_head, max_range_m);
    const terrain::Tile* met[kPacket] = {};
    for (const auto& [key, entry] : impl_->tiles) {  // in key order: of two tiles met at one range the first wins
      float before[kPacket];
      std::copy_n(packet.rays.ray.tfar, kPacket, before);
      RTCIntersectContext
          context;  // its COHERENT flag would lose rays at seams when a packet's directions differ in sign
      rtcInitIntersectContext(&context);
      rtcIntersect16(packet.on, entry.scene.get(), &context, &packet.rays);
      for (std::size_t lane = 0; lane < count; ++lane) {
        if (packet.rays.ray.tfar[lane] < before[lane]) met[lane] = &entry.tile;
      }
    }
    for (std::size_t lane = 0; lane < count; ++lane) {
      hits[first + lane] = met[lane] ? hit_of(packet, lane, *met[lane], head.position_enu_m, slowness_spm) : Hit{};
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
