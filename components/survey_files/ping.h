#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "components/survey_files/track.h"
#include "components/survey_files/vessel.h"
#include "kernels/water/refraction/profile.h"

namespace ensonify::survey_files {

/// A sounding as it was measured.
struct Measured {
  std::int64_t ping_ns = 0;  // UTC since 1970
  double delay_s = 0.0;      // of its sector's transmission
  double two_way_s = 0.0;
  double tilt_rad = 0.0;   // forward, in the transmitter's own frame
  double angle_rad = 0.0;  // to starboard, in the receiver's own frame
  const Array* transmitter = nullptr;
  const Array* receiver = nullptr;
  std::size_t transmit_centre = 0;  // which phase centre sends
};

/// The water that a ping is traced through.
struct Water {
  double face_speed_mps = 1500.0;
  /// Below the transducer as the profile in force; its first node is the transducer, with the speed at the face.
  refraction::SoundSpeedProfile profile = refraction::SoundSpeedProfile::uniform(1500.0);
};

/// As sounders trace: nodes of the profile above the transducer are left out, and the first one is the transducer's own
/// depth with the speed at its face.
Water water_below(double transducer_depth_m, double face_speed_mps, const std::vector<refraction::Knot>& profile);

/// The profile as it stands: the speed at the face is its own.
Water water_of_profile(double transducer_depth_m, const std::vector<refraction::Knot>& profile);

/// Place of a sounding in the world: heights count from the water line. Both cones are intersected, each with its own
/// array's mounting and attitude at its own time. Nothing where the track has no pose at transmission or reception, and
/// where times or angles are none or the arrays lie along each other then.
std::optional<frames::Vec3> place_enu_m(const Measured& measured, const Water& water, const Track& track);

/// Axes forward, starboard and down of a vessel with this heading, level.
frames::Quaternion level_from_enu(const frames::Pose& body);

}  // namespace ensonify::survey_files
