#include "components/multibeam/geometry.h"

#include <algorithm>
#include <cmath>

namespace ensonify {

using frames::Vec3;

Vec3 sounding_enu_m(const frames::HeadPose& at_transmit, const frames::HeadPose& at_receive, double sin_beam,
                    double travel_time_s, double sound_speed_mps) {
  const Vec3 a = at_transmit.enu_from_head * Vec3::UnitX();  // the transmit line: d . a = 0
  const Vec3 b = at_receive.enu_from_head * Vec3::UnitY();   // the receive line: the beam's cone is about it
  const double cross = a.dot(b);
  const Vec3 down = a.cross(b).normalized();
  const Vec3 moved = at_receive.position_enu_m - at_transmit.position_enu_m;
  const double path = sound_speed_mps * travel_time_s;

  // d is seen from the place of transmission, the cone's apex is the place of reception: the difference between the
  // sines at both is fed back. It is of the order moved / range, so three rounds leave its fourth power.
  double sine = sin_beam;
  Vec3 from_transmit = Vec3::Zero();
  for (int round = 0; round < 4; ++round) {
    const Vec3 in_plane = sine / (1.0 - cross * cross) * (b - cross * a);
    const Vec3 d = in_plane + std::sqrt(std::max(0.0, 1.0 - in_plane.squaredNorm())) * down;
    // |r d| + |r d - moved| = c t, solved for r.
    const double r = (path * path - moved.squaredNorm()) / (2.0 * (path - d.dot(moved)));
    from_transmit = r * d;
    const Vec3 from_receive = from_transmit - moved;
    sine += sin_beam - from_receive.dot(b) / from_receive.norm();
  }
  return at_transmit.position_enu_m + from_transmit;
}

}  // namespace ensonify
