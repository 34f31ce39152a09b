// Straight rays against a mesh; refracted.cpp has bent ones.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "kernels/acoustics/trace/packet.h"
#include "kernels/acoustics/trace/scene_impl.h"

namespace ensonify::trace {
namespace {

using frames::Vec3;

/// Rays of a ping that all leave from one place.
struct Source {
  Vec3 head_enu_m, start_m;  // start: in Embree's frame
  Eigen::Matrix3d enu_from_head;
  float max_range_m, slowness_spm;
};

/// Rays first..first + count - 1 in the lanes of a packet.
void aim(const Source& source, const Rays& rays, std::size_t first, std::size_t count, Packet& packet) {
  alignas(64) std::array<float, kPacket> x{}, y{}, z;
  z.fill(1.0F);
  std::copy_n(rays.direction_head.x.data() + first, count, x.data());
  std::copy_n(rays.direction_head.y.data() + first, count, y.data());
  std::copy_n(rays.direction_head.z.data() + first, count, z.data());
  const Eigen::Matrix3d& R = source.enu_from_head;
  const Eigen::Vector3f start = source.start_m.cast<float>();
  RTCRay16& ray = packet.rays.ray;
  for (std::size_t lane = 0; lane < kPacket; ++lane) {
    const auto a = static_cast<double>(x[lane]), b = static_cast<double>(y[lane]), c = static_cast<double>(z[lane]);
    ray.dir_x[lane] = static_cast<float>(R(0, 0) * a + (R(0, 1) * b + R(0, 2) * c));
    ray.dir_y[lane] = static_cast<float>(R(1, 0) * a + (R(1, 1) * b + R(1, 2) * c));
    ray.dir_z[lane] = static_cast<float>(R(2, 0) * a + (R(2, 1) * b + R(2, 2) * c));
  }
  for (std::size_t lane = 0; lane < kPacket; ++lane) {
    const bool used = lane < count;
    packet.on[lane] = used ? -1 : 0;
    packet.part_hit[lane] = nullptr;
    ray.org_x[lane] = start.x();
    ray.org_y[lane] = start.y();
    ray.org_z[lane] = start.z();
    ray.tnear[lane] = ray.time[lane] = 0.0F;
    ray.tfar[lane] = used ? source.max_range_m : 0.0F;
    ray.mask[lane] = ~0U;
    ray.id[lane] = ray.flags[lane] = 0;
    packet.rays.hit.Ng_x[lane] = packet.rays.hit.Ng_y[lane] = packet.rays.hit.Ng_z[lane] = 0.0F;
    packet.rays.hit.geomID[lane] = packet.rays.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  }
}

/// What a lane hit at this place.
std::uint32_t contributor_at(const Part& part, double x_enu_m, double y_enu_m) {
  return part.contributor_at({x_enu_m, y_enu_m});
}

/// What the lanes hit, into rows first..first + count - 1.
void note(const Source& source, const Packet& packet, std::size_t first, std::size_t count, Hits& hits) {
  alignas(64) std::array<std::int32_t, kPacket> hit;
  for (std::size_t lane = 0; lane < kPacket; ++lane) hit[lane] = packet.part_hit[lane] != nullptr ? 1 : 0;
  const RTCRay16& ray = packet.rays.ray;
  const RTCHit16& facet = packet.rays.hit;
  double *const x_m = hits.position_enu_m.x.data() + first, *const y_m = hits.position_enu_m.y.data() + first,
                *const z_m = hits.position_enu_m.z.data() + first;
  const Vec3 head = source.head_enu_m;
  for (std::size_t lane = 0; lane < count; ++lane) {
    const auto range_m = static_cast<double>(ray.tfar[lane]);
    const double x = head.x() + range_m * static_cast<double>(ray.dir_x[lane]);
    const double y = head.y() + range_m * static_cast<double>(ray.dir_y[lane]);
    const double z = head.z() + range_m * static_cast<double>(ray.dir_z[lane]);
    x_m[lane] = hit[lane] != 0 ? x : 0.0;
    y_m[lane] = hit[lane] != 0 ? y : 0.0;
    z_m[lane] = hit[lane] != 0 ? z : 0.0;
  }
  alignas(64) std::array<float, kPacket> nx, ny, nz, grazing;  // normals towards the head
  for (std::size_t lane = 0; lane < kPacket; ++lane) {
    const auto x = static_cast<double>(facet.Ng_x[lane]), y = static_cast<double>(facet.Ng_y[lane]),
               z = static_cast<double>(facet.Ng_z[lane]);
    const double per_length = 1.0 / std::sqrt(x * x + y * y + z * z);
    const double along = static_cast<double>(ray.dir_x[lane]) * x + static_cast<double>(ray.dir_y[lane]) * y +
                         static_cast<double>(ray.dir_z[lane]) * z;
    const double towards = along > 0.0 ? -per_length : per_length, sine = std::abs(along) * per_length;
    nx[lane] = static_cast<float>(towards * x);
    ny[lane] = static_cast<float>(towards * y);
    nz[lane] = static_cast<float>(towards * z);
    grazing[lane] = static_cast<float>(sine < 1.0 ? sine : 1.0);
  }
  const auto put = [&](std::vector<float>& column, const float* value, float of_a_miss) {
    float* const to = column.data() + first;
    for (std::size_t lane = 0; lane < count; ++lane) to[lane] = hit[lane] != 0 ? value[lane] : of_a_miss;
  };
  put(hits.normal_enu.x, nx.data(), 0.0F);
  put(hits.normal_enu.y, ny.data(), 0.0F);
  put(hits.normal_enu.z, nz.data(), 1.0F);
  put(hits.arrival_enu.x, ray.dir_x, 0.0F);
  put(hits.arrival_enu.y, ray.dir_y, 0.0F);
  put(hits.arrival_enu.z, ray.dir_z, 1.0F);
  put(hits.sin_grazing, grazing.data(), 0.0F);
  put(hits.range_m, ray.tfar, 0.0F);
  const float* const range_m = hits.range_m.data() + first;
  float *const time_s = hits.travel_time_s.data() + first, *const length_m = hits.path_length_m.data() + first,
               *const tube_m2 = hits.tube_m2.data() + first;
  for (std::size_t lane = 0; lane < count; ++lane) {
    time_s[lane] = range_m[lane] * source.slowness_spm;
    length_m[lane] = range_m[lane];
    tube_m2[lane] = range_m[lane] * range_m[lane];
  }
  for (std::size_t lane = 0; lane < count; ++lane) {
    const Part* const part = packet.part_hit[lane];
    hits.facet_m[first + lane] = part != nullptr ? part->facet_m() : 0.0F;
    hits.tile[first + lane] = part != nullptr ? part->number() : 0;
    hits.contributor[first + lane] = part != nullptr ? contributor_at(*part, x_m[lane], y_m[lane]) : 0;
  }
}

}  // namespace

std::span<const Object> Mesh::objects() const {
  return content_ ? std::span<const Object>(*content_->objects) : std::span<const Object>{};
}

std::span<const ShownBody> Mesh::bodies() const {
  return content_ ? std::span<const ShownBody>(content_->bodies) : std::span<const ShownBody>{};
}

const Contributors& Mesh::contributors() const {
  static const Contributors kNone;
  return content_ ? content_->contributors : kNone;
}

std::span<const double> Mesh::facet_mean_square_slope() const {
  return facet_mean_square_slope_ ? std::span<const double>(*facet_mean_square_slope_) : std::span<const double>{};
}

void Mesh::trace(const frames::HeadPose& head, const Rays& rays, float max_range_m, Hits& hits, double sound_speed_mps,
                 std::uint32_t behind) const {
  hits.make_elements(rays.size());
  if (!content_) {
    for (std::size_t i = 0; i < hits.size(); ++i) hits.set(i, Hit{});
    return;
  }
  const PartTree& tree = content_->tree;
  const auto of = behind == kAllBodies ? PartTree::Of::kSeabed : PartTree::Of::kAll;
  const Vec3 origin(content_->origin_enu_m.x(), content_->origin_enu_m.y(), 0.0);
  const Source source{head.position_enu_m, head.position_enu_m - origin, head.enu_from_head.toRotationMatrix(),
                      max_range_m, static_cast<float>(1.0 / sound_speed_mps)};
  const std::size_t packets = (rays.size() + kPacket - 1) / kPacket;
  const auto trace_packet = [&](std::size_t index) {
    const std::size_t first = index * kPacket;
    const std::size_t count = std::min(kPacket, rays.size() - first);
    Packet packet;
    aim(source, rays, first, count, packet);
    packet.intersect(tree, of);
    if (behind != kNoise && behind != kAllBodies) {
      float tfar_m[kPacket];
      std::ranges::fill(tfar_m, max_range_m);
      const RTCRay16& ray = packet.rays.ray;
      packet.pass(tree, behind, tfar_m, [&](std::size_t lane) {
        const auto range_m = static_cast<double>(ray.tfar[lane]);
        return contributor_at(*packet.part_hit[lane],
                              source.head_enu_m.x() + range_m * static_cast<double>(ray.dir_x[lane]),
                              source.head_enu_m.y() + range_m * static_cast<double>(ray.dir_y[lane]));
      });
    }
    note(source, packet, first, count, hits);
  };
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, packets, kChunk),
      [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) trace_packet(i);
      },
      tbb::simple_partitioner());
}

}  // namespace ensonify::trace
