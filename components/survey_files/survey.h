#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "kernels/base/frames/local_projection.h"
#include "kernels/base/frames/pose.h"

namespace ensonify::survey_files {

/// A sounding, placed anew from what was measured.
struct Placed {
  std::uint32_t ping = 0;  // its number in the file
  std::uint32_t head = 0;
  std::size_t sounding = 0;
  std::int64_t unix_ns = 0;                // UTC, of the ping
  frames::Vec3 place_m;                    // forward, starboard, down from the reference point, level, at the ping
  frames::Vec3 recorded_m;                 // the same as the file has it
  frames::Geodetic position;               // WGS 84
  frames::Vec3 place_enu_m;                // on a map about the file's first position; up from the water line
  frames::Vec3 head_enu_m;                 // the transmitter, at the ping
  std::optional<frames::MovingPose> body;  // the vessel at the ping; nothing within 0.1 s of the attitude's ends
  double depth_m = 0.0;                    // below the water line
  double height_m = 0.0;                   // above the ellipsoid, NaN where the file does not know it
};

/// What was found of a file besides.
struct Summary {
  std::size_t pings = 0, soundings = 0;
  std::size_t rejected = 0;          // by the sounder
  std::size_t without_attitude = 0;  // at transmission or reception
  std::uint64_t faults = 0;          // passed over
};

using TakePlaced = std::function<void(const Placed&)>;

struct Trace {
  bool surface_speed = true;  // at the transducer's face; else that of the profile
};

/// Places the accepted soundings of a .kmall file anew, in its order. Throws UserError where the file does not say what
/// is needed: installation, profile, attitude, position.
Summary place_kmall(const std::string& file, const Trace& trace, const TakePlaced& take);

/// The same of a .all file. Its own places of soundings are turned to the reference point.
Summary place_all(const std::string& file, const Trace& trace, const TakePlaced& take);

/// Either, as the content is. Throws UserError for another file.
Summary place_soundings(const std::string& file, const Trace& trace, const TakePlaced& take);

/// Whether it is a file that place_soundings() takes, by its content.
bool is_survey_file(const std::string& file);

}  // namespace ensonify::survey_files
