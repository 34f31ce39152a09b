#include "components/logger/ping_place.h"

#include <numbers>

#include "components/logger/head_track.h"

namespace ensonify::logger {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace

PingPlace place_of(const LoggedSoundings& ping, const Vessel& vessel) {
  PingPlace place;
  place.body = body_pose_of(ping.soundings.track, vessel);
  place.head_enu_m = frames::enu_from_body(place.body, vessel.head.position_body_m);
  place.reference = ping.world.geodetic_of(place.body.position_enu_m.head<2>());
  const double grid_heading_rad = frames::attitude_of(place.body.enu_from_body).heading_rad;
  place.heading_deg =
      frames::wrap_two_pi(grid_heading_rad + ping.world.convergence_rad(place.body.position_enu_m.head<2>())) / kDegree;
  place.level_from_enu = frames::enu_from_body(frames::Attitude{.heading_rad = grid_heading_rad}).conjugate();
  place.level_from_head = place.level_from_enu * place.body.enu_from_body * vessel.head.body_from_head;
  return place;
}

}  // namespace ensonify::logger
