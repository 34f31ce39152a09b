#include <fmt/format.h>

#include <algorithm>

#include "components/config/read_parameters.h"
#include "scenarios/world/vehicle_keys.h"

namespace ensonify {

frames::Mounting MountingKeys::mounting(frames::Mounting otherwise) const {
  if (roll_rad || pitch_rad || heading_rad) {
    const frames::Attitude turn{.heading_rad = heading_rad.value_or(0.0),
                                .pitch_rad = pitch_rad.value_or(0.0),
                                .roll_rad = roll_rad.value_or(0.0)};
    // The same three turns as a vehicle's attitude, from the body's axes instead of from north, east, down.
    otherwise.body_from_head = frames::canonical(frames::enu_from_ned().conjugate() * frames::enu_from_body(turn));
  }
  if (position_m) otherwise.position_body_m = *position_m;
  return otherwise;
}

void VehicleKeys::check(const ConfigReader& from) const {
  if (!start) return;
  const motion::State& state = start->state;
  if (!floats && state.position_enu_m.z() > 0.0) {
    from.problem("start.position_m",
                 fmt::format("up {} is above the water; allowed: 0 or less, or a vehicle with floats",
                             state.position_enu_m.z()));
  }
  if (state.speed_mps > fastest_mps) {
    from.problem("start", fmt::format("speed_mps {} is above fastest_mps {}", state.speed_mps, fastest_mps));
  }
}

Vehicle VehicleKeys::vehicle() const {
  Vehicle vehicle;
  vehicle.name = name;
  if (const auto* forces = std::get_if<MovesByForces>(&kind)) vehicle.dynamics_file = forces->dynamics;
  vehicle.limits = limits;
  vehicle.fastest_mps = fastest_mps;
  if (roll) vehicle.waves.roll_rad = *roll;
  if (heave) vehicle.waves.heave_m = *heave;
  if (disturbance) vehicle.disturbance = disturbance->si();
  if (floats) vehicle.floats = floats->loading();
  if (start) vehicle.start = start->state;
  for (const auto& [head, keys] : mountings) {
    HeadMounting& mounting = vehicle.mountings[head];
    mounting.actual = mounting.measured = keys.actual.mounting();
    if (keys.measured) mounting.measured = keys.measured->mounting(mounting.actual);
  }
  return vehicle;
}

Vehicle own_vehicle(const ConfigReader& from, const World& world, const std::string& process,
                    const std::string& wanted) {
  std::string names;
  const auto find = [&](const std::string& name) {
    return std::find_if(world.vehicles.begin(), world.vehicles.end(),
                        [&](const Vehicle& vehicle) { return vehicle.name == name; });
  };
  if (const auto found = find(wanted.empty() ? process : wanted); found != world.vehicles.end()) return *found;
  if (wanted.empty() && world.vehicles.size() == 1) return world.vehicles.front();

  for (const Vehicle& vehicle : world.vehicles) names += (names.empty() ? "" : ", ") + vehicle.name;
  if (world.vehicles.empty()) {
    from.problem("vehicle", "the scenario " + world.file + " has no vehicle");
  } else if (wanted.empty()) {
    from.problem("vehicle", "is missing, and no vehicle is named " + process + "; allowed: " + names);
  } else {
    from.problem("vehicle", "\"" + wanted + "\" is no vehicle of the scenario; allowed: " + names);
  }
  return {};
}

const Vehicle* follower(const World& world) {
  if (!world.mission.follow) return nullptr;
  const std::string& wanted = world.mission.follow->vehicle;
  const Vehicle* found = nullptr;
  for (const Vehicle& vehicle : world.vehicles) {
    const bool may = wanted.empty() ? world.vehicles.size() == 1 || !vehicle.start : vehicle.name == wanted;
    if (may && found != nullptr) return nullptr;
    if (may) found = &vehicle;
  }
  return found;
}

}  // namespace ensonify
