#pragma once

#include "kernels/frames/pose.h"

namespace ensonify {

/// Where a beam's echo comes from when sound travels straight at one speed: the direction that lies in the transmit
/// fan (across the transmit line, as that was turned at transmission) and on the receive beam's cone (about the receive
/// line, as that was turned at reception), on the ellipsoid of equal travel time about the two places.
///
/// Both lines are those of a Mills cross: x and y of the head's frame. sin_beam is the sine of the beam's angle from
/// the plane across the receive line, positive to starboard.
frames::Vec3 sounding_enu_m(const frames::HeadPose& at_transmit, const frames::HeadPose& at_receive, double sin_beam,
                            double travel_time_s, double sound_speed_mps);

}  // namespace ensonify
