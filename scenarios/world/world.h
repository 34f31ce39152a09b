#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "components/config/config_node.h"
#include "components/config/parameter_info.h"
#include "kernels/base/frames/local_projection.h"
#include "kernels/base/frames/pose.h"
#include "kernels/vehicle/motion/current.h"
#include "kernels/vehicle/motion/disturbance.h"
#include "kernels/vehicle/motion/kinematics.h"
#include "kernels/vehicle/vertical/floating.h"
#include "kernels/vehicle/vertical/reduction.h"
#include "kernels/vehicle/vertical/tide.h"
#include "messages/terrain.h"
#include "scenarios/scenario_file.h"
#include "scenarios/world/mission.h"
#include "scenarios/world/objects.h"
#include "scenarios/world/seabed.h"
#include "scenarios/world/water.h"

namespace ensonify {

class ConfigReader;

/// Relation of heights: the water level above chart datum, and chart datum between geoid and ellipsoid.
struct Vertical {
  vertical::Tide tide;
  vertical::Datums datums;
};

/// The tide of a gauge: lines "2025-06-01T12:00:00Z,1.35", time in UTC and metres above chart datum, times rising;
/// lines that start with # and a first line of column names are skipped. Throws ConfigError with places in that file.
vertical::GaugeReadings read_gauge(const std::string& path, double start_unix_s);

/// A grid of separations, an Esri ASCII file (ncols, nrows, xllcorner, yllcorner, cellsize, NODATA_value if there is
/// one, then rows from north to south, cell centres) in the world's own metres; cells without a value are refused.
/// Throws ConfigError with the place of what is wrong.
vertical::Separation read_separation(const std::string& path);

/// Place of the world. ENU x = y = 0 is at the origin, z = 0 is chart datum.
struct Site {
  std::string name = "unnamed";
  /// `origin: raster` in the file: the centre of the imported raster, known only after somebody has opened it.
  bool origin_from_raster = false;
  frames::Geodetic origin;
};

/// A head on its vehicle: where it truly is, and where its makers of records estimate it to be.
struct HeadMounting {
  frames::Mounting actual;
  frames::Mounting measured;
};

struct Vehicle {
  std::string name;
  /// Given: the vehicle moves by its forces, as this file says; the limits below are what its planners count on.
  std::string dynamics_file;
  motion::Limits limits;
  double fastest_mps = 10.0;
  motion::Waves waves;
  motion::DisturbanceParameters disturbance;
  /// Given: it floats on the water level, this much deeper than its reference point. Not given: as deep as the mission
  /// says below the water level.
  std::optional<vertical::Loading> floats;
  /// Not given: at the start of the first runline, at its heading, at mission speed.
  std::optional<motion::State> start;
  std::map<std::string, HeadMounting> mountings;  // by the head's process name
};

/// The world of a run. Everybody reads all of it. SI and radians; the file has degrees, and knots where it says so.
struct World : ScenarioHeader {
  std::string file;
  Site site;
  std::string text;                    // of the scenario, canonical, as it is recorded; empty unless a launch named it
  std::optional<std::int64_t> end_ns;  // sim time, where the launch has an end of its own
  Water water;
  Vertical vertical;
  motion::Current current;
  Seabed seabed;
  std::vector<SceneObject> objects;  // in the order of the file
  std::vector<Vehicle> vehicles;     // in the order of the file
  Mission mission;

  /// The world of a launch's scenario; the defaults when it names none. Throws ConfigError with every problem.
  static World read(const ScenarioFile& scenario);

  /// By name; the only vehicle when the name is "". Throws std::out_of_range.
  const Vehicle& vehicle(const std::string& name = "") const;
  /// Mounting of a head on whichever vehicle carries it: the vehicle's name and the mounting, or nothing.
  std::optional<std::pair<std::string, HeadMounting>> mounting(const std::string& head) const;
};

/// Steps of a mission beyond a vehicle's limits or against the current, as problems of `from`: speeds, orbits, bends,
/// headway.
void check_mission(const ConfigReader& from, const Mission& mission, const Vehicle& vehicle,
                   const motion::Current& current);
/// Heads of a vehicle that never come below the water.
void check_heads(const ConfigReader& from, const Mission& mission, const Vehicle& vehicle);

/// Keys of a scenario file, of a mission's, and of the steps of a mission: for schemas and tables.
ParameterList scenario_list();
ParameterList mission_file_list();
ParameterList step_list();

/// Reads a scenario file: one from here, or the project's own (data_paths.h). Throws ConfigError with every problem.
World read_world(const std::string& path, const Overrides& overrides = {});

/// Reads an already parsed scenario; problems stay in the reader for its finish(). `written` takes what a file would
/// have with every value.
World read_world(ConfigReader& from, const std::string& file, std::string* written = nullptr);

/// The vehicle that a process belongs to: the one that its configuration names under `vehicle` (`wanted`), else the one
/// that has the process's name, else the scenario's only one. Anything else is a problem of `from`, and the result a
/// default.
Vehicle own_vehicle(const ConfigReader& from, const World& world, const std::string& process,
                    const std::string& wanted);

/// The vehicle that goes along the mission's recorded track: the one it names, else the only one, else the only one
/// without a start. nullptr: there is no track to follow.
const Vehicle* follower(const World& world);

/// Part of the scenario that determines the survey lines.
struct MissionPlan {
  std::string scenario_file;
  Mission mission;
  motion::Limits limits;  // of the vehicle that runs them

  static MissionPlan of(const World& world, const Vehicle& vehicle);
  /// The lines are known only when the chart is.
  bool needs_chart() const { return mission.auto_plan.has_value(); }
};

/// The survey lines in order: the scenario's own, or for `auto` laid over the chart. Whoever asks with the same
/// scenario and chart gets the same lines. Throws ConfigError naming mission.auto when the chart has no room for them.
std::vector<runlines::Runline> planned_lines(const MissionPlan& plan, const msg::Chart& chart);

/// Start of a vehicle without a place: at the start of the first line's run-in, on its way at mission speed.
motion::State start_of(const MissionPlan& plan, const std::vector<runlines::Runline>& lines);

}  // namespace ensonify
