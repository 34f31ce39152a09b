#include "kernels/trace/mesh.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "kernels/lod/patch.h"

namespace ensonify::trace {
namespace {

/// On all sides: without it one ray in ten million that runs along the border of two parts is lost between them.
constexpr float kSlack_m = 1e-3F;

/// Around all posts under the leaf, as the patch has them.
RTCBounds bounds_of(const Shown& shown, const terrain::Vec2& origin_enu_m) {
  const auto [low, high] = shown.hierarchy->box_enu_m(shown.leaf.block);
  const auto lower = [](double value) { return static_cast<float>(value) - kSlack_m; };
  const auto upper = [](double value) { return static_cast<float>(value) + kSlack_m; };
  return {lower(low.x() - origin_enu_m.x()),  lower(low.y() - origin_enu_m.y()),  lower(low.z()),  0.0F,
          upper(high.x() - origin_enu_m.x()), upper(high.y() - origin_enu_m.y()), upper(high.z()), 0.0F};
}

EmbreeScene scene_of(RTCDevice device, const lod::Patch& patch) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_GRID);
  static_assert(sizeof(patch.vertices_m[0]) == 3 * sizeof(float));
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                           patch.vertices_m.size());
  std::memcpy(vertices, patch.vertices_m.data(), patch.vertices_m.size() * 3 * sizeof(float));
  void* grids =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), patch.grids.size());
  std::ranges::transform(patch.grids, static_cast<RTCGrid*>(grids), [](const lod::Patch::Grid& grid) {
    return RTCGrid{grid.first, grid.stride, grid.columns, grid.rows};
  });
  rtcCommitGeometry(geometry);
  EmbreeScene scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  return scene;
}

}  // namespace

Device new_device() {
  // Embree's memory of a small scene in few pieces.
  Device device(rtcNewDevice("isa=avx2,set_affinity=0,alloc_thread_block_size=8192"));
  if (!device) throw std::runtime_error("Embree cannot start (it needs a processor with AVX2)");
  return device;
}

void check(RTCDevice device, const char* fault) {
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw std::runtime_error(fault);
}

struct Part::Built {
  EmbreeScene scene;
  std::size_t triangles;
};

Part::Part(const Device& device, const Shown& shown, const terrain::Vec2& origin_enu_m)
    : device_(device.get()), shown_(shown), origin_enu_m_(origin_enu_m), bounds_(bounds_of(shown, origin_enu_m)) {}

Part::~Part() { delete built_.load(); }

RTCScene Part::scene() const {
  const Built* built = built_.load(std::memory_order_acquire);
  return (built != nullptr ? built : build())->scene.get();
}

std::size_t Part::triangles() const {
  const Built* built = built_.load(std::memory_order_acquire);
  return built != nullptr ? built->triangles : 0;
}

float Part::facet_m() const { return static_cast<float>(std::ldexp(tile().spacing_m, shown_.leaf.level)); }

const Part::Built* Part::build() const {
  const lod::Patch patch = lod::patch_of(tile(), *shown_.hierarchy, shown_.leaf, shown_.rim, origin_enu_m_);
  auto made = std::make_unique<Built>(Built{scene_of(device_, patch), patch.triangles()});
  // Isolated: a thread that waits here must not take up other rays, for it may be in the middle of some.
  tbb::this_task_arena::isolate([&] { rtcCommitScene(made->scene.get()); });
  check(device_, "Embree could not build a part of the seabed");
  const Built* kept = nullptr;
  return built_.compare_exchange_strong(kept, made.get()) ? made.release() : kept;
}

void Mesh::assign(const Device& device, std::span<const Part* const> parts) {
  parts_.assign(parts.begin(), parts.end());
  scene_.reset();
  if (parts_.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(parts_.size()));
  rtcSetGeometryUserData(geometry, parts_.data());
  rtcSetGeometryBoundsFunction(geometry, bound, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect);
  rtcCommitGeometry(geometry);
  scene_.reset(rtcNewScene(device.get()));
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_.get());
}

void Mesh::bound(const RTCBoundsFunctionArguments* of) {
  *of->bounds_o = static_cast<const Part* const*>(of->geometryUserPtr)[of->primID]->bounds();
}

/// Embree asks with as many rays as it likes to trace together.
void Mesh::intersect(const RTCIntersectFunctionNArguments* of) {
  RTCScene scene = static_cast<const Part* const*>(of->geometryUserPtr)[of->primID]->scene();
  of->context->instID[0] = of->primID;  // is written into what hits
  if (of->N == 1) {
    if (of->valid[0] != 0) rtcIntersect1(scene, of->context, reinterpret_cast<RTCRayHit*>(of->rayhit));
  } else if (of->N == 4) {
    rtcIntersect4(of->valid, scene, of->context, reinterpret_cast<RTCRayHit4*>(of->rayhit));
  } else if (of->N == 8) {
    rtcIntersect8(of->valid, scene, of->context, reinterpret_cast<RTCRayHit8*>(of->rayhit));
  } else {
    rtcIntersect16(of->valid, scene, of->context, reinterpret_cast<RTCRayHit16*>(of->rayhit));
  }
  of->context->instID[0] = RTC_INVALID_GEOMETRY_ID;
}

}  // namespace ensonify::trace
