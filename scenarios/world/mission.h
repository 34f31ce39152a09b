#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "kernels/base/frames/local_projection.h"
#include "kernels/vehicle/motion/kinematics.h"
#include "kernels/vehicle/runlines/runline.h"

namespace ensonify {

class ConfigReader;

/// `auto` in the file: runlines laid over an imported raster by whoever can read it.
struct AutoPlan {
  int count = 5;
  double longest_m = 500.0;
  double overlap = 0.2;                // of neighbouring swaths, 0..1
  double swath_rad = 2.2689280275926;  // 130 deg, from which the spacing follows
  std::optional<double> spacing_m;     // given: instead of the overlap
  std::optional<double> heading_rad;   // given: instead of the longer side of the data
};

/// `adaptive` in the file: parallel lines over a rectangle, each laid where the coverage so far ends.
struct AdaptivePlan {
  runlines::Vec2 centre_enu_m = runlines::Vec2::Zero();
  double heading_rad = 0.0;            // of the first line; the survey goes on to starboard of it
  double length_m = 100.0;             // of a line
  double width_m = 100.0;              // of the rectangle, across the lines
  double first_line_m = 0.0;           // distance of the first line from the rectangle's port edge
  double swath_rad = 2.0943951023932;  // full angle that counts on, 120 deg
  double overlap = 0.1;                // of a half swath with what is covered, 0..1
  double cell_m = 4.0;                 // side of a cell of the coverage
  int soundings = 9;                   // accepted ones that a covered cell has at least
};

// --- the steps of a mission, in the order run -------------------------------------------------------------------

/// A line through two places or more, with run-in and run-out.
struct FollowLine {
  std::vector<runlines::Vec2> points_enu_m;
};
/// Pass through a place, on a heading where one is given.
struct PassPlace {
  runlines::Vec2 place_enu_m;
  std::optional<double> heading_rad;
};
/// Go to a place (not given: where the vehicle is), stop and stay there.
struct KeepPlace {
  std::optional<runlines::Vec2> place_enu_m;
  double for_s = 0.0;
  double within_m = 5.0;
};
struct FollowOrbit {
  runlines::Vec2 centre_enu_m;
  double radius_m = 0.0;
  double turns = 1.0;
  bool clockwise = true;  // the centre to starboard
};
/// Speed and depth from here on; what is not given stays. A depth ends an altitude and the other way round.
struct GoAt {
  std::optional<double> speed_mps, depth_m, altitude_m;
};
struct SetSonar {
  std::string head;
  std::optional<double> range_m, source_level_db, pulse_length_s, gain_spreading_db, gain_absorption_dbpm,
      gain_offset_db, swath_rad, ping_rate_hz;
  std::string mode;  // "": stays
};
struct SetMark {
  std::string text;
};
using MissionStep = std::variant<FollowLine, PassPlace, KeepPlace, FollowOrbit, GoAt, SetSonar, SetMark>;

/// Rules for giving a mission up: come to the surface, stop and end the run. Not given: never.
struct AbortRules {
  std::optional<double> after_s;        // of sim time
  std::optional<double> position_sd_m;  // estimated, the larger horizontal axis
  std::optional<double> too_low_s;      // this long below the least altitude in one piece
};

struct Mission {
  double speed_mps = 2.0;
  double depth_m = 0.0;  // of the vehicle's reference point below the water level
  std::optional<double>
      altitude_m;                 // above the bottom, by the altimeter; given: instead of the depth, once it is known
  double least_altitude_m = 0.0;  // obstacle floor; 0: none
  double run_in_m = 10.0;
  double run_out_m = 0.0;
  int repeat = 1;                           // times that the steps are run
  std::vector<MissionStep> steps;           // in order; lawnmowers are already laid out
  std::vector<runlines::Runline> runlines;  // all straight pieces of the steps' lines, in order
  std::optional<AutoPlan> auto_plan;        // set: `steps` is empty until it has been resolved
  std::optional<AdaptivePlan> adaptive;     // set: `steps` is the first line only
  AbortRules abort;
  /// Depth at which each of `runlines` is run, below the water level; nothing where the bottom is followed.
  std::vector<std::optional<double>> runline_depths_m() const;
  std::vector<std::string> sonars() const;  // heads that SetSonar names, in order, each once
};

inline constexpr const char* kMissionFormat = "mission/1";

/// `mission:` of a scenario; its keys may stand in a file of their own (`file:`), mission/1, and then some of them here
/// as well: those count. Places are metres in the world, or with `positions: geodetic` degrees [latitude, longitude];
/// what lies farther than 100 km from `origin` is a problem, which says if latitude and longitude look swapped. Without
/// an origin (it comes from a raster) geodetic places are a problem.
Mission read_mission(ConfigReader from, const std::optional<frames::Geodetic>& origin);

/// The depth in force after an order, given the one before it; nothing: the bottom is followed.
std::optional<double> depth_after(const GoAt& order, std::optional<double> before_m);

/// Steps for plain lines.
std::vector<MissionStep> steps_of(const std::vector<runlines::Runline>& lines);

/// The first line of an adaptive survey.
runlines::Runline first_line(const AdaptivePlan& plan);

/// Steps of a mission beyond a vehicle's limits, as problems of `from`: speeds, orbits.
void check_mission(const ConfigReader& from, const Mission& mission, const std::string& vehicle, double fastest_mps,
                   const motion::Limits& limits, bool floats);

}  // namespace ensonify
