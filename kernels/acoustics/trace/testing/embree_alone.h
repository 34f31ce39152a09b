#pragma once

#include <embree3/rtcore.h>

#include <span>
#include <vector>

#include "kernels/acoustics/trace/ray.h"
#include "kernels/base/frames/pose.h"
#include "kernels/mesh/tile.h"

namespace ensonify::trace {

/// Embree with nothing around it: one tile as one grid, packets made beforehand, hits left in them. The floor that
/// benchmarks compare with; it runs on the calling thread, with Embree's flag for coherent rays whatever their signs.
class EmbreeAlone {
 public:
  explicit EmbreeAlone(const terrain::Tile& tile) {
    RTCGeometry grid = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_GRID);
    auto* v = static_cast<float*>(
        rtcSetNewGeometryBuffer(grid, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, tile.height_m.size()));
    for (int row = 0; row < tile.rows; ++row) {
      for (int column = 0; column < tile.columns; ++column) {
        const auto post = tile.position_enu_m(column, row);
        for (int axis = 0; axis < 3; ++axis) *v++ = static_cast<float>(post[axis]);
      }
    }
    auto* g = static_cast<RTCGrid*>(
        rtcSetNewGeometryBuffer(grid, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), 1));
    *g = {0, static_cast<unsigned>(tile.columns), static_cast<unsigned short>(tile.columns),
          static_cast<unsigned short>(tile.rows)};
    rtcCommitGeometry(grid);
    rtcAttachGeometry(scene_, grid);
    rtcReleaseGeometry(grid);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_);
  }
  ~EmbreeAlone() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeAlone(const EmbreeAlone&) = delete;
  EmbreeAlone& operator=(const EmbreeAlone&) = delete;

  /// Rays that do not fill a packet of 16 are left out.
  static std::vector<RTCRayHit16> packets_of(const frames::HeadPose& head, const Rays& rays) {
    std::vector<RTCRayHit16> packets(rays.size() / 16);
    const Eigen::Matrix3d turn = head.enu_from_head.toRotationMatrix();
    for (std::size_t i = 0; i < packets.size() * 16; ++i) {
      auto& packet = packets[i / 16];
      const std::size_t lane = i % 16;
      const frames::Vec3 d = turn * rays[i].direction_head.cast<double>();
      packet.ray.org_x[lane] = static_cast<float>(head.position_enu_m.x());
      packet.ray.org_y[lane] = static_cast<float>(head.position_enu_m.y());
      packet.ray.org_z[lane] = static_cast<float>(head.position_enu_m.z());
      packet.ray.dir_x[lane] = static_cast<float>(d.x());
      packet.ray.dir_y[lane] = static_cast<float>(d.y());
      packet.ray.dir_z[lane] = static_cast<float>(d.z());
      packet.ray.tnear[lane] = packet.ray.time[lane] = 0.0F;
      packet.ray.mask[lane] = ~0U;
    }
    return packets;
  }

  void trace(std::span<RTCRayHit16> packets, float max_range_m) const {
    alignas(64) int on[16];
    for (int& lane : on) lane = -1;
    for (auto& packet : packets) {
      for (int lane = 0; lane < 16; ++lane) {
        packet.ray.tfar[lane] = max_range_m;
        packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      }
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
      rtcIntersect16(on, scene_, &context, &packet);
    }
  }

 private:
  RTCDevice device_ = rtcNewDevice("isa=avx2,set_affinity=0");
  RTCScene scene_ = rtcNewScene(device_);
};

}  // namespace ensonify::trace
