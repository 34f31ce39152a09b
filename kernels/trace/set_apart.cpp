#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/trace/ray_distribution.h"

namespace ensonify::trace {
namespace {

using frames::Vec3;

constexpr double kWidestObject_rad = 0.25;    // half: probes see what is wider
constexpr double kAroundObject = 0.03;        // of its width, to either side
constexpr double kRaysPerObjectFacet = 40.0;  // that faces the head: many are seen edge-on

}  // namespace

/// The directions in which a box lies become parts of their own.
void RayDistribution::set_apart(const Object& object, const Look& probes) {
  const auto head_from_enu = probes.enu_from_head.transpose();
  const Vec3 centre = head_from_enu * (object.box_enu_m.center() - probes.head.position_enu_m);
  const double half_m = 0.5 * object.box_enu_m.diagonal().norm(), far_m = centre.norm() + half_m;
  if (far_m - 2.0 * half_m > probes.max_range_m || half_m > kWidestObject_rad * centre.norm()) return;
  const bool forward = volume_.axis == TransmitVolume::Axis::kForward;
  const auto along = [&](const Vec3& d) { return forward ? d.x() : d.z(); };
  const auto angle_rad = [&](const Vec3& d) { return std::atan2(d.y(), forward ? d.z() : d.x()); };

  const double middle_rad = angle_rad(centre);
  Part box{1.0, -1.0, std::numbers::pi, -std::numbers::pi, 0, {}};
  for (int c = 0; c < 8; ++c) {
    const Vec3 corner = object.box_enu_m.corner(static_cast<Eigen::AlignedBox3d::CornerType>(c));
    const Vec3 d = (head_from_enu * (corner - probes.head.position_enu_m)).normalized();
    const double from_middle_rad = std::remainder(angle_rad(d) - middle_rad, 2.0 * std::numbers::pi);
    box.low_sine = std::min(box.low_sine, along(d)), box.high_sine = std::max(box.high_sine, along(d));
    box.low_rad = std::min(box.low_rad, from_middle_rad), box.high_rad = std::max(box.high_rad, from_middle_rad);
  }
  const double more = kAroundObject * (box.high_sine - box.low_sine), turn = 2.0 * std::numbers::pi;
  const double more_rad = kAroundObject * (box.high_rad - box.low_rad);
  box.low_sine -= more, box.high_sine += more;
  box.low_rad += middle_rad - more_rad, box.high_rad += middle_rad + more_rad;
  box.need.sine_to_angle = (box.high_sine - box.low_sine) / (box.high_rad - box.low_rad);
  for (const double around_rad : {-turn, 0.0, turn}) {  // angles of the volume need not lie within half a circle of 0
    Part turned = box;
    turned.low_rad += around_rad, turned.high_rad += around_rad;
    set_apart(turned, settings_.quality * kRaysPerObjectFacet * facing_facets_per_sr(far_m, object.facet_m));
  }
}

void RayDistribution::set_apart(const Part& box, double rays_per_sr) {
  const std::size_t parts = parts_.size();
  if (2 * parts > settings_.most_rays) return;  // each has a ray
  for (std::size_t k = 0; k < parts; ++k) {
    const Part whole = parts_[k];
    Part inside = whole;
    inside.low_sine = std::max(whole.low_sine, box.low_sine);
    inside.high_sine = std::min(whole.high_sine, box.high_sine);
    inside.low_rad = std::max(whole.low_rad, box.low_rad);
    inside.high_rad = std::min(whole.high_rad, box.high_rad);
    if (!(inside.low_sine < inside.high_sine && inside.low_rad < inside.high_rad)) continue;
    const auto share_of = [&](const Part& part) { return part.solid_angle_sr() / whole.solid_angle_sr(); };
    const auto leave = [&](double low_sine, double high_sine, double low_rad, double high_rad) {
      Part rest{low_sine, high_sine, low_rad, high_rad, whole.cell, whole.need};
      rest.need.rays *= share_of(rest);
      if (low_sine < high_sine && low_rad < high_rad) parts_.push_back(rest);
    };
    leave(whole.low_sine, inside.low_sine, whole.low_rad, whole.high_rad);
    leave(inside.high_sine, whole.high_sine, whole.low_rad, whole.high_rad);
    leave(inside.low_sine, inside.high_sine, whole.low_rad, inside.low_rad);
    leave(inside.low_sine, inside.high_sine, inside.high_rad, whole.high_rad);
    const double object_rays = rays_per_sr * inside.solid_angle_sr() * importance_of(whole.cell);
    inside.need.rays =
        std::min(std::max(whole.need.rays * share_of(inside), object_rays), static_cast<double>(settings_.most_rays));
    inside.need.plane_m = 0.0;
    if (object_rays >= inside.need.rays) {
      inside.need.sine_to_angle = (inside.high_sine - inside.low_sine) / (inside.high_rad - inside.low_rad);
    }
    parts_[k] = inside;
  }
}

}  // namespace ensonify::trace
