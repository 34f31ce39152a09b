#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "components/runtime/config/config_node.h"
#include "components/runtime/config/scenario_mission.h"
#include "components/runtime/config/scenario_seabed.h"
#include "components/runtime/config/scenario_vertical.h"
#include "components/runtime/config/scenario_water.h"
#include "kernels/frames/local_projection.h"
#include "kernels/frames/pose.h"
#include "kernels/motion/current.h"
#include "kernels/motion/disturbance.h"
#include "kernels/motion/kinematics.h"
#include "kernels/vertical/draught.h"

namespace ensonify {

class ConfigReader;

/// Where the world is. ENU x = y = 0 is at the origin, z = 0 is chart datum.
struct Site {
  std::string name = "unnamed";
  /// `origin: raster` in the file: the centre of the imported raster, known only after somebody has opened it.
  bool origin_from_raster = false;
  frames::Geodetic origin;
};

/// A head on its vehicle: where it truly is, and where its makers of records believe it to be.
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
struct Scenario {
  std::string file;
  Site site;
  std::string start_utc = "2025-06-01T00:00:00Z";  // of sim time 0
  std::int64_t start_unix_ns = 1748736000000000000;
  std::uint64_t seed = 1;
  Water water;
  Vertical vertical;
  motion::Current current;
  Seabed seabed;
  std::vector<Vehicle> vehicles;  // in the order of the file
  Mission mission;

  /// By name; the only vehicle when the name is "". Throws std::out_of_range.
  const Vehicle& vehicle(const std::string& name = "") const;
  /// Mounting of a head on whichever vehicle carries it: the vehicle's name and the mounting, or nothing.
  std::optional<std::pair<std::string, HeadMounting>> mounting(const std::string& head) const;
};

inline constexpr const char* kScenarioFormat = "scenario/1";

/// Values to set before reading: ("water.salinity_psu", value). Their places appear in messages.
using Overrides = std::vector<std::pair<std::string, ConfigNode>>;

/// Reads a scenario file. Throws ConfigError with every problem.
Scenario read_scenario(const std::string& path, const Overrides& overrides = {});

/// Reads an already parsed scenario; problems stay in the reader for its finish().
Scenario read_scenario(ConfigReader& from, const std::string& file);

/// Applies overrides to a tree; a path that leads nowhere is a problem.
std::vector<ConfigProblem> apply(const Overrides& overrides, ConfigNode& root);

/// Nanoseconds since 1970-01-01 UTC of "2025-06-01T12:00:00Z" (fractions of a second allowed), or nothing.
std::optional<std::int64_t> parse_utc_ns(const std::string& text);

/// Checks `ensonify: launch/1` at the head of a file against the format that the reader knows.
void read_format(ConfigReader& from, const std::string& known_format);

}  // namespace ensonify
