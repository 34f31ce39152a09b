#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/base/frames/pose.h"

namespace ensonify::survey_files {

/// An array as it is installed: place and turn, and from there, in its own frame, its phase centres: of a transmitter
/// those of its port, centre and starboard array, of a receiver one.
struct Array {
  frames::Mounting installed;
  std::vector<frames::Vec3> phase_centre_m;

  /// The mounting of a phase centre; the last one beyond them.
  frames::Mounting mounting(std::size_t phase_centre) const;
};

/// What a file says of its vessel. Places are forward, starboard and down from the reference point.
struct Vessel {
  std::vector<Array> transmitters, receivers;
  int motion_sensor = 0;  // number of the active one, from 0
  frames::Quaternion body_from_motion_sensor = frames::Quaternion::Identity();
  double water_line_m = 0.0;  // of the vessel at rest, down
};

/// By the installation text of a .kmall file. Throws UserError with `file` and the group that is missing or wrong.
Vessel vessel_of_kmall(const std::string& file, std::string_view text);

/// What the installation of a .all file says besides.
struct VesselOfAll : Vessel {
  frames::Vec3 origin_m;              // of x and y of soundings: the active antenna's place at the water line
  bool heave_at_transmitter = false;  // where heave counts: there, without rotation, or at the reference point
};

/// By the installation text of a .all file, for this model, with the phase centres that its makers state for it. Throws
/// UserError for a key that is missing or wrong, and for two transmitters.
VesselOfAll vessel_of_all(const std::string& file, std::string_view text, std::uint16_t model);

/// Turned by degrees of roll, pitch and heading.
frames::Quaternion turn_of(double roll_deg, double pitch_deg, double heading_deg);

}  // namespace ensonify::survey_files
