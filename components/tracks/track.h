#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kernels/base/frames/local_projection.h"

/// Tracks that were recorded, whatever the format of the file.
namespace ensonify::tracks {

// Times are nanoseconds of the file's own clock, whose zero means nothing here.

struct Fix {
  std::int64_t ns = 0;
  frames::Geodetic place;
};
/// A place in metres of the world.
struct Spot {
  std::int64_t ns = 0;
  frames::Vec2 place_enu_m = frames::Vec2::Zero();
};
struct Value {
  std::int64_t ns = 0;
  double value = 0.0;
};

/// What a file says of where a vehicle was and how it lay, each at times of its own, which rise. What it does not say
/// is empty.
struct Track {
  std::string file;                // for messages
  std::vector<Fix> fixes;          // either these
  std::vector<Spot> spots;         // or these
  std::vector<Value> heading_rad;  // from true north; beside `spots` from grid north
  std::vector<Value> roll_rad;     // port up
  std::vector<Value> pitch_rad;    // bow up
  std::vector<Value> heave_m;      // up
  std::vector<Value> depth_m;      // of what is tracked, below the water level
  std::vector<Value> height_m;     // of it above chart datum
};

/// Reads a track, in the format that the file's content has: CSV, a log of NMEA lines, an MCAP record, .all, .kmall or
/// XTF. `topic` is that of the poses or estimates in a record; "": its only topic of poses. Throws UserError with the
/// place in the file, the cause and what is allowed.
Track read_track(const std::string& file, const std::string& topic = "");

}  // namespace ensonify::tracks
