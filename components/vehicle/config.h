#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/config/parameters.h"
#include "components/vehicle/dynamics_file.h"
#include "components/vehicle/pilots.h"
#include "scenarios/world/world.h"

namespace ensonify {

namespace tracks {
class FollowedTrack;
}

/// The water that a vehicle is in.
struct VehicleWater {
  vertical::Tide tide;
  motion::Current current;
  std::optional<vertical::Loading> floats;  // not given: it holds its depth below the water level
};

struct VehicleParameters {
  std::string vehicle;
  int pose_rate_hz = 100;
  std::vector<PilotKeys> steered_by;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("vehicle", "", any(), "vehicle of the scenario; \"\": the one with the process's name, or the only one",
          self.vehicle);
    visit("pose_rate_hz", "Hz", in(1, 1000), "true poses published per second", self.pose_rate_hz);
    visit("steered_by", "processes that may steer it by their topic command: the first whose commands come does",
          self.steered_by);
  }
};

struct VehicleConfig : VehicleParameters {
  // From the scenario.
  motion::Limits limits;
  double fastest_mps = 10.0;
  motion::Waves waves;
  motion::DisturbanceParameters disturbance;
  std::uint64_t seed = 1;
  std::string name;  // of the vehicle
  VehicleWater water;
  std::optional<HydrodynamicVehicle> hydrodynamics;       // not given: kinematic
  std::shared_ptr<const tracks::FollowedTrack> followed;  // not given: it is commanded
  std::optional<motion::State> start;                     // not given: at the first line's run-in
  MissionPlan plan;

  static VehicleConfig read(ConfigReader& from, const World& world, const std::string& process);
  /// Takes the track that the mission follows; what is wrong with it is a problem of `from`.
  void follow(ConfigReader& from, const World& world);
  /// Need of the chart: the vehicle's start is known only with it.
  bool needs_chart() const { return !start && plan.needs_chart(); }
};

}  // namespace ensonify
