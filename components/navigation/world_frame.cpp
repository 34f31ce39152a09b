#include "components/navigation/world_frame.h"

#include <numbers>

#include "components/runtime/sim_time.h"

namespace ensonify {

constexpr double kDegree = std::numbers::pi / 180.0;

frames::Quaternion enu_from_true_ned(const frames::LocalProjection& world, const frames::Vec2& place_enu_m) {
  const Eigen::AngleAxisd grid_from_true(-world.convergence_rad(place_enu_m), frames::Vec3::UnitZ());
  return frames::enu_from_ned() * grid_from_true;
}

inertial::NavigationState geodetic_state(const frames::MovingPose& body, const frames::Mounting& mounting,
                                         const frames::LocalProjection& world) {
  const frames::HeadPose instrument = frames::head_pose(body.pose, mounting);
  const frames::Vec2 place = instrument.position_enu_m.head<2>();
  const frames::Geodetic geodetic = world.geodetic_of(place);
  const frames::Quaternion ned_from_enu = enu_from_true_ned(world, place).conjugate();
  const frames::Vec3 swing = body.angular_rate_body_radps.cross(mounting.position_body_m);
  return {geodetic.latitude_deg * kDegree, geodetic.longitude_deg * kDegree, instrument.position_enu_m.z(),
          ned_from_enu * (body.velocity_enu_mps + body.pose.enu_from_body * swing),
          ned_from_enu * instrument.enu_from_head};
}

frames::MovingPose moving_pose(const msg::Pose& pose) {
  const auto& [x, y, z] = pose.position_enu_m;
  const auto& [u, v, w] = pose.velocity_enu_mps;
  const auto& [p, q, r] = pose.rate_body_radps;
  return {{{x, y, z}, frames::quaternion_of(pose.enu_from_body)}, {u, v, w}, {p, q, r}};
}

void report_position(msg::Position& position, const frames::LocalProjection& world, const vertical::Datums& datums) {
  const auto& [east_m, north_m, up_m] = position.position_enu_m;
  const frames::Geodetic place = world.geodetic_of({east_m, north_m});
  position.latitude_deg = place.latitude_deg;
  position.longitude_deg = place.longitude_deg;
  position.height_above_geoid_m = vertical::geoid_height_m(datums, {east_m, north_m, up_m});
  position.geoid_above_ellipsoid_m = datums.geoid_above_ellipsoid.at({east_m, north_m});
}

double Heights::mean_m(const msg::Pose& body) const {
  const double t_s = seconds(SimTime{body.stamp_ns});
  const double unladen_m = water_level_m(t_s) + rest_m;
  if (!floats) return unladen_m;
  const frames::Vec2 over_ground(body.velocity_enu_mps[0], body.velocity_enu_mps[1]);
  const double through_water_mps = (over_ground - current.velocity_enu_mps(-unladen_m, t_s)).norm();
  return unladen_m - vertical::sinkage_m(*floats, through_water_mps, t_s);
}

}  // namespace ensonify
