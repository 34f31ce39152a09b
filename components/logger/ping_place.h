#pragma once

#include "components/logger/format.h"
#include "components/logger/vessel.h"

namespace ensonify::logger {

/// Where and how a ping was made, by the estimate. Level: forward, starboard, down, of the vessel's heading.
struct PingPlace {
  frames::Pose body;
  frames::Vec3 head_enu_m;
  frames::Geodetic reference;
  double heading_deg = 0.0;  // true, 0 to 360
  frames::Quaternion level_from_enu, level_from_head;
};
PingPlace place_of(const LoggedSoundings& ping, const Vessel& vessel);

}  // namespace ensonify::logger
