#include "kernels/acoustics/trace/parts.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "kernels/base/isa/isa.h"
#include "kernels/mesh/lod/cover.h"

namespace ensonify::trace {
namespace {

/// Whether the directions of a packet agree in sign along each axis. Embree then may trace it as one
/// (RTC_INTERSECT_CONTEXT_FLAG_COHERENT); of others it would lose rays at seams.
bool in_one_octant(const int* on, const RTCRay16& rays) {
  std::uint32_t any = 0, all = ~0U;  // sign bits of the lanes that are on, bit per axis
  for (std::size_t lane = 0; lane < 16; ++lane) {
    const auto sign = [lane](const float(&component)[16]) {
      return std::bit_cast<std::uint32_t>(component[lane]) >> 31;
    };
    const std::uint32_t signs = sign(rays.dir_x) | sign(rays.dir_y) << 1 | sign(rays.dir_z) << 2;
    const auto lane_on = static_cast<std::uint32_t>(on[lane]);  // all bits or none
    any |= signs & lane_on;
    all &= signs | ~lane_on;
  }
  return any == (all & 7U);
}

/// Around all posts under the leaf, as the patch has them.
RTCBounds bounds_of(const Shown& shown, const terrain::Vec2& origin_enu_m) {
  const auto [low, high] = shown.ground->hierarchy.box_enu_m(shown.leaf.block);
  const auto lower = [](double value) { return static_cast<float>(value) - kPartSlack_m; };
  const auto upper = [](double value) { return static_cast<float>(value) + kPartSlack_m; };
  return {lower(low.x() - origin_enu_m.x()),  lower(low.y() - origin_enu_m.y()),  lower(low.z()),  0.0F,
          upper(high.x() - origin_enu_m.x()), upper(high.y() - origin_enu_m.y()), upper(high.z()), 0.0F};
}

/// What Embree hands to callbacks. It is C: no exception may pass through it.
struct Query : RTCIntersectContext {
  std::exception_ptr failure;
  PartTree::Of of = PartTree::Of::kAll;
};

/// kNoise where sediments differ.
std::uint32_t contributor_of_all(const Shown& shown) {
  const terrain::Tile& tile = shown.ground->tile;
  return tile.sediment.empty() ? sediment_contributor(tile.everywhere) : kNoise;
}

float facet_of(const Shown& shown) {
  return static_cast<float>(std::ldexp(shown.ground->tile.spacing_m, shown.leaf.level));
}

}  // namespace

Device new_device() {
  // Embree's memory of a small scene in few pieces.
  const std::string isa = name_of(isa_in_use());
  Device device(rtcNewDevice(("isa=" + isa + ",set_affinity=0,alloc_thread_block_size=8192").c_str()));
  if (!device) throw std::runtime_error("Embree cannot start (it needs a processor with " + isa + ")");
  return device;
}

void check(RTCDevice device, const char* fault) {
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw std::runtime_error(fault);
}

struct Part::Built {
  EmbreeScene scene;
  std::size_t triangles;
};

Part::Part(RTCDevice device, const RTCBounds& bounds, std::uint32_t number, float facet_m, std::uint32_t contributor)
    : device_(device), bounds_(bounds), number_(number), facet_m_(facet_m), contributor_(contributor) {}

Part::~Part() { delete built_.load(); }

RTCScene Part::scene() const {
  const Built* built = built_.load(std::memory_order_acquire);
  return (built != nullptr ? built : build())->scene.get();
}

std::size_t Part::triangles() const {
  const Built* built = built_.load(std::memory_order_acquire);
  return built != nullptr ? built->triangles : 0;
}

const Part::Built* Part::build() const {
  const Content made = content();
  rtcCommitGeometry(made.geometry.get());
  auto one = std::make_unique<Built>(Built{EmbreeScene(rtcNewScene(device_)), made.triangles});
  rtcSetSceneFlags(one->scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcAttachGeometry(one->scene.get(), made.geometry.get());
  // Isolated: a thread that waits here must not take up other rays, for it may be in the middle of some.
  tbb::this_task_arena::isolate([&] { rtcCommitScene(one->scene.get()); });
  check(device_, "Embree could not build a part of the seabed");
  const Built* kept = nullptr;
  return built_.compare_exchange_strong(kept, one.get()) ? one.release() : kept;
}

void* Part::new_buffer(const Geometry& geometry, RTCBufferType type, RTCFormat format, std::size_t element_bytes,
                       std::size_t count) const {
  void* buffer = rtcSetNewGeometryBuffer(geometry.get(), type, 0, format, element_bytes, count);
  if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::bad_alloc();
  return buffer;
}

BlockPart::BlockPart(const Device& device, const Shown& shown, const terrain::Vec2& origin_enu_m)
    : Part(device.get(), bounds_of(shown, origin_enu_m), shown.number, facet_of(shown), contributor_of_all(shown)),
      shown_(shown),
      origin_enu_m_(origin_enu_m) {}

std::uint32_t BlockPart::contributor_of(const terrain::Vec2& place_enu_m) const {
  return sediment_contributor(terrain::sediment_at(shown_.ground->tile, place_enu_m));
}

Part::Content BlockPart::content() const {
  const lod::Patch patch =
      lod::patch_of(shown_.ground->tile, shown_.ground->hierarchy, shown_.leaf, shown_.rim, origin_enu_m_);
  Geometry geometry(rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_GRID));
  static_assert(sizeof(patch.vertices_m[0]) == 3 * sizeof(float));
  void* vertices =
      new_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3 * sizeof(float), patch.vertices_m.size());
  std::memcpy(vertices, patch.vertices_m.data()->data(), patch.vertices_m.size() * 3 * sizeof(float));
  void* grids = new_buffer(geometry, RTC_BUFFER_TYPE_GRID, RTC_FORMAT_GRID, sizeof(RTCGrid), patch.grids.size());
  std::ranges::transform(patch.grids, static_cast<RTCGrid*>(grids), [](const lod::Patch::Grid& grid) {
    return RTCGrid{grid.first, grid.stride, grid.columns, grid.rows};
  });
  return {std::move(geometry), patch.triangles()};
}

PartTree::PartTree(const Device& device, std::vector<std::shared_ptr<const Part>> parts) : parts_(std::move(parts)) {
  if (parts_.empty()) return;
  const Geometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(parts_.size()));
  rtcSetGeometryUserData(geometry.get(), parts_.data());
  rtcSetGeometryBoundsFunction(geometry.get(), bound, nullptr);
  rtcSetGeometryIntersectFunction(geometry.get(), enter);
  rtcCommitGeometry(geometry.get());
  EmbreeScene scene(rtcNewScene(device.get()));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcAttachGeometry(scene.get(), geometry.get());
  rtcCommitScene(scene.get());
  check(device.get(), "Embree could not build the tree over the parts of the seabed");
  scene_ = std::move(scene);
}

void PartTree::intersect(const int* on, RTCRayHit16& rays, Of of) const {
  if (!scene_) return;
  Query query;
  query.of = of;
  rtcInitIntersectContext(&query);
  if (in_one_octant(on, rays.ray)) query.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(on, scene_.get(), &query, &rays);
  if (query.failure) std::rethrow_exception(query.failure);
}

void PartTree::bound(const RTCBoundsFunctionArguments* of) {
  *of->bounds_o = static_cast<const std::shared_ptr<const Part>*>(of->geometryUserPtr)[of->primID]->bounds();
}

/// Embree asks with as many rays as it likes to trace together.
void PartTree::enter(const RTCIntersectFunctionNArguments* of) {
  auto& query = *static_cast<Query*>(of->context);
  auto& failure = query.failure;
  if (failure) return;
  const Part& part = *static_cast<const std::shared_ptr<const Part>*>(of->geometryUserPtr)[of->primID];
  if (query.of == Of::kSeabed && part.is_body()) return;
  RTCScene scene = nullptr;
  try {
    scene = part.scene();
  } catch (...) {
    failure = std::current_exception();
    return;
  }
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
