#include "kernels/trace/mesh.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace ensonify::trace {
namespace {

/// On all sides: without it one ray in ten million that runs along the border of two parts is lost between them.
constexpr float kSlack_m = 1e-3F;

void widen(RTCBounds& bounds) {
  for (float* low : {&bounds.lower_x, &bounds.lower_y, &bounds.lower_z}) *low -= kSlack_m;
  for (float* high : {&bounds.upper_x, &bounds.upper_y, &bounds.upper_z}) *high += kSlack_m;
}

}  // namespace

Device new_device() {
  Device device(rtcNewDevice("isa=avx2,set_affinity=0"));
  if (!device) throw std::runtime_error("Embree cannot start (it needs a processor with AVX2)");
  return device;
}

void check(const Device& device, const char* fault) {
  if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE) throw std::runtime_error(fault);
}

Part part_of(const Device& device, const lod::Patch& patch) {
  Part part;
  if (patch.grids.empty()) return part;
  part.triangles = patch.triangles();
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_GRID);
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
  part.scene.reset(rtcNewScene(device.get()));
  rtcSetSceneFlags(part.scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcAttachGeometry(part.scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(part.scene.get());
  rtcGetSceneBounds(part.scene.get(), &part.bounds);
  widen(part.bounds);
  return part;
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
  *of->bounds_o = static_cast<const Part* const*>(of->geometryUserPtr)[of->primID]->bounds;
}

/// Embree asks with as many rays as it likes to trace together.
void Mesh::intersect(const RTCIntersectFunctionNArguments* of) {
  RTCScene scene = static_cast<const Part* const*>(of->geometryUserPtr)[of->primID]->scene.get();
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
