#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <limits>

#include "kernels/acoustics/trace/bent_packet.h"
#include "kernels/acoustics/trace/packet.h"
#include "kernels/acoustics/trace/scene_impl.h"

namespace ensonify::trace {
namespace {

using frames::Vec2;
using frames::Vec3;
using refraction::Leg;
using refraction::Path;
using refraction::PathPoint;

constexpr double kMargin_m = 0.01;  // around the geometry's heights

/// A ray on its way: where its path is, and the chord that comes next.
struct Lane {
  Path path;
  Vec2 slowness_spm;  // horizontal components, the same all along (Snell)
  Leg leg{};
  bool last = false;  // the chord ends at the greatest range

  Lane(const Path& on, const Vec2& horizontal_slowness_spm) : path(on), slowness_spm(horizontal_slowness_spm) {}

  Vec3 at(const Vec3& start, double source_depth_m) const {
    const double reach = path.at().reach_m2ps;
    return {start.x() + reach * slowness_spm.x(), start.y() + reach * slowness_spm.y(),
            start.z() + source_depth_m - path.at().depth_m};
  }
  /// Direction of travel at a place on the path.
  Vec3 direction(const PathPoint& point) const {
    return {point.speed_mps * slowness_spm.x(), point.speed_mps * slowness_spm.y(), -point.sine};
  }
  Vec3 chord() const {
    const double speed = leg.mean_scale * (path.at().speed_mps + leg.end_speed_mps);  // chord_cosine / invariant
    return {speed * slowness_spm.x(), speed * slowness_spm.y(), -leg.chord_sine};
  }

  /// Goes on until the path is between the band's depths; false when it never is.
  bool reach(const Band& band, double max_length_m) {
    for (;;) {
      const double depth = path.at().depth_m;
      if (path.at().length_m >= max_length_m) return false;
      if (depth > band.top_m || (depth == band.top_m && path.heads_down())) {
        return depth < band.bottom_m || (depth == band.bottom_m && !path.heads_down());
      }
      if (!approach(band.top_m)) return false;
    }
  }

  /// One leg further, at most down to this depth; false when the path never ends it. Few rays need it.
  [[gnu::noinline]] bool approach(double top_m) {
    const Leg above = path.leg_within(-std::numeric_limits<double>::infinity(), top_m);
    if (above.endless()) return false;
    path.take(above);
    return true;
  }

  void next_chord(const Band& band, double max_length_m) {
    const double left = max_length_m - path.at().length_m;
    last = false;
    leg = path.leg_within(band.top_m, band.bottom_m);
    const double curvature = std::abs(path.curvature_pm());
    const bool flat = leg.chord_m * leg.chord_m * curvature <= 8.0 * kOffArc_m;  // sagitta of an arc: L^2 / 8R
    if (flat && leg.chord_m + kOverlap_m < left) return;
    double length = leg.endless() ? left : path.length_of(leg);
    last = length >= left;
    length = std::min(length, left);
    if (curvature > 0.0) {
      const double chords = std::ceil(length / std::sqrt(8.0 * kOffArc_m / curvature));
      if (chords > 1.0) {
        length /= chords;
        last = false;
      }
    }
    leg = path.leg_of_length(length);
  }
};

Hit hit_of(const Packet& packet, std::size_t lane_index, const Lane& lane, const Vec3& chord_start_enu_m,
           const Vec3& head_enu_m) {
  const double along = packet.rays.ray.tfar[lane_index];
  const Vec3 chord = lane.chord();
  const PathPoint end = lane.path.end_of(lane.path.leg_of_length(along));
  const Vec3 arrival = lane.direction(end), normal = packet.normal(lane_index);
  Hit hit;
  hit.position_enu_m = chord_start_enu_m + along * chord;
  hit.normal_enu = (normal.dot(chord) > 0.0 ? Vec3(-normal) : normal).cast<float>();
  hit.arrival_enu = arrival.cast<float>();
  hit.range_m = static_cast<float>((hit.position_enu_m - head_enu_m).norm());
  hit.travel_time_s = static_cast<float>(end.time_s);
  hit.path_length_m = static_cast<float>(end.length_m);
  hit.tube_m2 = static_cast<float>(lane.path.tube_m2(end));
  hit.sin_grazing = static_cast<float>(std::min(1.0, std::abs(normal.dot(arrival))));
  hit.facet_m = packet.part_hit[lane_index]->facet_m();
  hit.tile = packet.part_hit[lane_index]->number();
  hit.contributor = packet.part_hit[lane_index]->contributor_at(hit.position_enu_m.head<2>());
  return hit;
}

using Lanes = std::array<std::int32_t, kPacket>;  // 0: not this one

/// The lanes that are left: all where one needs more than the table, those that go on where one of the packet needs
/// more than one chord a layer.
Lanes trace_side_by_side(const BentPacket::Source& source, const Rays& rays, std::size_t first, std::size_t count,
                         const PartTree& tree, PartTree::Of of, Hits& hits) {
  BentPacket bent;
  if (!bent.aim(source, rays, first, count)) return bent.left();
  Packet packet;
  do {
    if (!bent.cross(source, packet)) return bent.left();
    packet.intersect(tree, of);
    bent.note(source, packet, hits);
  } while (bent.go_on(source, packet));
  return {};
}

}  // namespace

void Mesh::tabulate(const refraction::SoundSpeedProfile& profile, const frames::HeadPose& head, double head_depth_m,
                    float max_range_m, refraction::PathTable& paths) const {
  const auto heights =
      content_ ? heights_near(content_->extents, head.position_enu_m.head<2>(), max_range_m) : std::nullopt;
  const double above = heights ? head.position_enu_m.z() - heights->highest_m - kMargin_m : 0.0;
  paths.build(profile, head_depth_m, head_depth_m + above);
}

void Mesh::trace(const frames::HeadPose& head, const Rays& rays, float max_range_m, Hits& hits,
                 const refraction::PathTable& paths, std::uint32_t behind) const {
  hits.make_elements(rays.size());
  const auto heights =
      content_ ? heights_near(content_->extents, head.position_enu_m.head<2>(), max_range_m) : std::nullopt;
  if (!heights) {
    for (std::size_t i = 0; i < hits.size(); ++i) hits.set(i, Hit{});
    return;
  }
  const double source_depth = paths.source_depth_m(), z = head.position_enu_m.z();
  const Band band{source_depth + (z - heights->highest_m - kMargin_m),
                  source_depth + (z - heights->lowest_m + kMargin_m)};
  const double source_slowness = paths.profile().slowness_spm(source_depth);
  const bool use_table = paths.level_m() <= band.top_m;
  const Eigen::Matrix3d enu_from_head = head.enu_from_head.toRotationMatrix();
  const PartTree& tree = content_->tree;
  const auto of = behind == kAllBodies ? PartTree::Of::kSeabed : PartTree::Of::kAll;
  const Vec3 origin(content_->origin_enu_m.x(), content_->origin_enu_m.y(), 0.0);
  const Vec3 start = head.position_enu_m - origin;

  const Layers layers(paths, band);
  const bool side_by_side = !layers.empty() && (behind == kNoise || behind == kAllBodies);
  const BentPacket::Source source{paths, layers,      enu_from_head,  head.position_enu_m,
                                  start, max_range_m, source_slowness};

  const auto trace_packet = [&](std::size_t index) {
    const std::size_t first = index * kPacket, count = std::min(kPacket, rays.size() - first);
    Lanes left{};
    std::fill_n(left.begin(), count, -1);
    if (side_by_side) left = trace_side_by_side(source, rays, first, count, tree, of, hits);
    if (left == Lanes{}) return;
    std::array<std::optional<Lane>, kPacket> lanes;
    std::array<Vec3, kPacket> from;
    Packet packet;
    std::size_t alive = 0;
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
      if (left[lane] == 0) {
        packet.switch_off(lane);
        continue;
      }
      const Vec3 direction = enu_from_head * rays.direction_head[first + lane].cast<double>();
      const double sine = -direction.z(), cosine = direction.head<2>().norm();
      lanes[lane].emplace(use_table ? paths.path(sine, cosine) : Path(paths.profile(), source_depth, sine, cosine),
                          source_slowness * direction.head<2>());
      if (lanes[lane]->reach(band, max_range_m)) {
        ++alive;
      } else {
        packet.switch_off(lane);
        lanes[lane].reset();
        hits.set(first + lane, Hit{});
      }
    }
    while (alive > 0) {
      for (std::size_t lane = 0; lane < count; ++lane) {
        if (!lanes[lane]) continue;
        Lane& ray = *lanes[lane];
        ray.next_chord(band, max_range_m);
        from[lane] = ray.at(start, source_depth);
        packet.set(lane, from[lane], ray.chord(), static_cast<float>(ray.leg.chord_m + (ray.last ? 0.0 : kOverlap_m)));
      }
      float tfar_m[kPacket] = {};
      for (std::size_t lane = 0; lane < kPacket; ++lane) tfar_m[lane] = packet.rays.ray.tfar[lane];
      packet.intersect(tree, of);
      if (behind != kNoise && behind != kAllBodies) {
        packet.pass(tree, behind, tfar_m, [&](std::size_t lane) {
          return hit_of(packet, lane, *lanes[lane], from[lane] + origin, head.position_enu_m).contributor;
        });
      }
      for (std::size_t lane = 0; lane < count; ++lane) {
        if (!lanes[lane]) continue;
        Lane& ray = *lanes[lane];
        if (packet.part_hit[lane]) {
          hits.set(first + lane, hit_of(packet, lane, ray, from[lane] + origin, head.position_enu_m));
        } else if (!ray.last) {
          ray.path.take(ray.leg);
          if (ray.reach(band, max_range_m)) continue;
          hits.set(first + lane, Hit{});
        } else {
          hits.set(first + lane, Hit{});
        }
        lanes[lane].reset();
        packet.on[lane] = 0;
        --alive;
      }
    }
  };
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, (rays.size() + kPacket - 1) / kPacket, kChunk),
      [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) trace_packet(i);
      },
      tbb::simple_partitioner());
}

}  // namespace ensonify::trace
