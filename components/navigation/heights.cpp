#include "components/navigation/heights.h"

#include "components/runtime/sim_time.h"

namespace ensonify {

double Heights::mean_m(const msg::Pose& body) const {
  const double t_s = seconds(SimTime{body.stamp_ns});
  const double unladen_m = water_level_m(t_s) + rest_m;
  if (!floats) return unladen_m;
  const frames::Vec2 over_ground(body.velocity_enu_mps[0], body.velocity_enu_mps[1]);
  const double through_water_mps = (over_ground - current.velocity_enu_mps(-unladen_m, t_s)).norm();
  return unladen_m - vertical::sinkage_m(*floats, through_water_mps, t_s);
}

}  // namespace ensonify
