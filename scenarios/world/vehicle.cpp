#include <fmt/format.h>

#include <algorithm>

#include "components/config/read_parameters.h"
#include "scenarios/world/sections.h"
#include "scenarios/world/world.h"

namespace ensonify {
namespace {

struct Angles {
  frames::Attitude turn;

  static void parameters(auto& self, auto&& visit) {
    visit("roll_deg", "deg", in(-180, 180), "starboard side down", self.turn.roll_rad);
    visit("pitch_deg", "deg", in(-90, 90), "bow up", self.turn.pitch_rad);
    visit("heading_deg", "deg", in(-360, 360), "to starboard", self.turn.heading_rad);
  }
};
struct Place {
  frames::Vec3 position_m = frames::Vec3::Zero();

  static void parameters(auto& self, auto&& visit) {
    visit("position_m", "m", in(-500, 500), "from the vehicle's reference point: forward, starboard, down",
          self.position_m);
  }
};

frames::Mounting read_mounting(ConfigReader from, frames::Mounting mounting = {}) {
  if (from.has("roll_deg") || from.has("pitch_deg") || from.has("heading_deg")) {
    Angles angles;
    read_parameters(from, angles);
    // The same three turns as a vehicle's attitude, from the body's axes instead of from north, east, down.
    mounting.body_from_head =
        frames::canonical(frames::enu_from_ned().conjugate() * frames::enu_from_body(angles.turn));
  }
  Place place{mounting.position_body_m};
  read_parameters(from, place);
  mounting.position_body_m = place.position_m;
  return mounting;
}

HeadMounting read_head(ConfigReader& from) {
  HeadMounting head;
  head.actual = read_mounting(from.section("actual"));
  const auto measured = from.optional_section("measured");
  head.measured = measured ? read_mounting(*measured, head.actual) : head.actual;
  return head;
}

/// A regular wave as a file has it.
void wave_parameters(auto& wave, auto&& visit, const char* amplitude, const char* unit, double most) {
  visit(amplitude, unit, must(in(0, most)), "amplitude of the motion", wave.amplitude);
  visit("period_s", "s", in(0.2, 60), "period of the wave", wave.period_s);
  visit("phase_deg", "deg", in(-360, 360), "phase at the start", wave.phase_rad);
}
struct Roll : motion::Sinusoid {
  Roll() { period_s = 6.0; }
  static void parameters(auto& self, auto&& visit) { wave_parameters(self, visit, "amplitude_deg", "deg", 60); }
};
struct Heave : motion::Sinusoid {
  Heave() { period_s = 6.0; }
  static void parameters(auto& self, auto&& visit) { wave_parameters(self, visit, "amplitude_m", "m", 20); }
};
struct RegularWaves {
  std::optional<Roll> roll;
  std::optional<Heave> heave;

  static void parameters(auto& self, auto&& visit) {
    visit("roll", "a regular roll", self.roll);
    visit("heave", "a regular heave", self.heave);
  }
};

struct Start {
  motion::State state;

  static void parameters(auto& self, auto&& visit) {
    visit("position_m", "m", must(in(-kFarAway_m, kFarAway_m)), "east, north, up from the water level",
          self.state.position_enu_m);
    visit("heading_deg", "deg", in(-360, 360), "heading at the start", self.state.heading_rad);
    visit("speed_mps", "m/s", in(0, 30), "speed at the start", self.state.speed_mps);
  }
};

void read_start(ConfigReader& from, Vehicle& vehicle) {
  const ConfigNode* start = from.node("start");
  if (start == nullptr || (start->is_scalar() && start->scalar == "first_runline")) {
    return;
  }
  if (!start->is_map()) {
    from.problem("start", "is neither first_runline nor a map of position_m, heading_deg, speed_mps");
    return;
  }
  auto section = from.section("start");
  Start start_state;
  read_parameters(section, start_state);
  const motion::State& state = start_state.state;
  if (!vehicle.floats && state.position_enu_m.z() > 0.0) {
    section.problem("position_m", fmt::format("up {} is above the water; allowed: 0 or less, or a vehicle with floats",
                                              state.position_enu_m.z()));
  }
  vehicle.start = state;
}

struct VehicleKind {
  bool by_forces = false;

  static void parameters(auto& self, auto&& visit) {
    visit("kind", "", one_of({{"kinematic", false}, {"hydrodynamic", true}}),
          "moves as its limits say, or by forces as its dynamics say", self.by_forces);
  }
};
struct Abilities {
  motion::Limits limits;
  double fastest_mps = Vehicle{}.fastest_mps;

  static void parameters(auto& self, auto&& visit) {
    visit("acceleration_mps2", "m/s^2", in(1e-3, 20), "speeding up", self.limits.acceleration_mps2);
    visit("deceleration_mps2", "m/s^2", in(1e-3, 20), "slowing down", self.limits.deceleration_mps2);
    visit("turning_radius_m", "m", in(0.1, 1000), "of the tightest circle", self.limits.turning_radius_m);
    visit("turn_rate_dps", "deg/s", computed(in(0.01, 360)), "fastest turn; left out: none but the circle's",
          self.limits.turn_rate_radps);
    visit("turn_acceleration_dps2", "deg/s^2", in(0.1, 10000), "how fast a turn begins and ends",
          self.limits.turn_acceleration_radps2);
    visit("vertical_speed_mps", "m/s", in(1e-3, 20), "up and down", self.limits.vertical_speed_mps);
    visit("vertical_acceleration_mps2", "m/s^2", in(1e-3, 20), "how fast climbs and dives begin and end",
          self.limits.vertical_acceleration_mps2);
    visit("fastest_mps", "m/s", in(0.01, 30), "speed through the water, at most", self.fastest_mps);
  }
  Abilities() {
    limits.turn_acceleration_radps2 = 10.0 * kDegrees.si;  // assumed: a launch has its turn in a second or two
    limits.vertical_acceleration_mps2 = 0.2;               // assumed: an AUV has its climb in two or three
  }
};

}  // namespace

Vehicle read_vehicle(const std::string& name, ConfigReader& from) {
  Vehicle vehicle;
  vehicle.name = name;
  VehicleKind kind;
  read_parameters(from, kind);
  if (kind.by_forces) {
    from.required_path("dynamics", vehicle.dynamics_file);
  } else if (from.has("dynamics")) {
    from.problem("dynamics", "needs kind: hydrodynamic");
  }
  Abilities abilities;
  read_parameters(from, abilities);
  vehicle.limits = abilities.limits;
  vehicle.fastest_mps = abilities.fastest_mps;
  RegularWaves waves;
  read_parameters(from, waves);
  if (waves.roll) vehicle.waves.roll_rad = *waves.roll;
  if (waves.heave) vehicle.waves.heave_m = *waves.heave;
  if (const auto disturbance = from.optional_section("disturbance")) {
    vehicle.disturbance = read_disturbance(*disturbance);
  }
  if (const auto floats = from.optional_section("floats")) {
    vehicle.floats = read_loading(*floats);
  }
  read_start(from, vehicle);
  if (vehicle.start && vehicle.start->speed_mps > vehicle.fastest_mps) {
    from.problem("start",
                 fmt::format("speed_mps {} is above fastest_mps {}", vehicle.start->speed_mps, vehicle.fastest_mps));
  }
  for (auto& [head, mounting] : from.named_sections("mountings")) {
    vehicle.mountings[head] = read_head(mounting);
  }
  return vehicle;
}

ParameterList vehicle_list() {
  ParameterList list = parameters_of<VehicleKind>(), mounting = parameters_of<Place>();
  for (ParameterInfo& info : parameters_of<Angles>()) mounting.push_back(std::move(info));
  list.push_back(file_info("dynamics", "of a hydrodynamic vehicle", false));
  for (ParameterInfo& info : parameters_of<Abilities>()) list.push_back(std::move(info));
  for (ParameterInfo& info : parameters_of<RegularWaves>()) list.push_back(std::move(info));
  list.push_back(section_info("disturbance", "an irregular sea", disturbance_list()));
  list.push_back(
      section_info("floats", "it floats on the water level; left out: it is at the mission's depth", loading_list()));
  list.push_back(word_or_info("start", "where it is at the start", "first_runline", parameters_of<Start>()));
  list.push_back(named_info("mountings", "heads that it carries, by their processes' names",
                            {section_info("actual", "where the head truly is", mounting, true),
                             section_info("measured", "where it is taken to be; left out: as actual", mounting)}));
  return list;
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

}  // namespace ensonify
