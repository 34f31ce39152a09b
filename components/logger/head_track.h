#pragma once

#include "components/logger/vessel.h"
#include "messages/sonar.h"

namespace ensonify::logger {

/// Whether the head knew where it was: else there is no ping to log.
bool has_track(const msg::HeadTrack& track);
/// The body at transmission, by the estimate.
frames::Pose body_pose_of(const msg::HeadTrack& track, const Vessel& vessel);

}  // namespace ensonify::logger
