// Straight rays against a mesh; refracted.cpp has bent ones.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "kernels/acoustics/trace/packet.h"
#include "kernels/acoustics/trace/scene_impl.h"

namespace ensonify::trace {
namespace {

using frames::Vec3;

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

std::span<const Object> Mesh::objects() const {
  return content_ ? std::span<const Object>(*content_->objects) : std::span<const Object>{};
}

std::span<const double> Mesh::facet_mean_square_slope() const {
  return facet_mean_square_slope_ ? std::span<const double>(*facet_mean_square_slope_) : std::span<const double>{};
}

void Mesh::trace(const frames::HeadPose& head, const Rays& rays, float max_range_m, Hits& hits, double sound_speed_mps,
                 std::uint32_t behind) const {
  const auto slowness_spm = static_cast<float>(1.0 / sound_speed_mps);
  hits.make_elements(rays.size());
  if (!content_) {
    for (std::size_t i = 0; i < hits.size(); ++i) hits.set(i, Hit{});
    return;
  }
  const PartTree& tree = content_->tree;
  const Eigen::Matrix3d enu_from_head = head.enu_from_head.toRotationMatrix();
  const Vec3 start(head.position_enu_m.x() - content_->origin_enu_m.x(),
                   head.position_enu_m.y() - content_->origin_enu_m.y(), head.position_enu_m.z());
  const std::size_t packets = (rays.size() + kPacket - 1) / kPacket;
  const auto trace_packet = [&](std::size_t index) {
    const std::size_t first = index * kPacket;
    const std::size_t count = std::min(kPacket, rays.size() - first);
    Packet packet;
    for (std::size_t lane = 0; lane < count; ++lane) {
      packet.set(lane, start, enu_from_head * rays.direction_head[first + lane].cast<double>(), max_range_m);
    }
    for (std::size_t lane = count; lane < kPacket; ++lane) packet.switch_off(lane);
    packet.intersect(tree);
    if (behind != kNoise) {
      float tfar_m[kPacket];
      std::ranges::fill(tfar_m, max_range_m);
      packet.pass(tree, behind, tfar_m, [&](std::size_t lane) {
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
