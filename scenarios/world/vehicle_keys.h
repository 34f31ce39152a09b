#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>

#include "scenarios/world/motion_keys.h"
#include "scenarios/world/world.h"

/// One of `vehicles:` of a scenario as its file has it.
namespace ensonify {

/// Where a head is on its vehicle. The angles stand together: where one is given, the others are 0.
struct MountingKeys {
  std::optional<frames::Vec3> position_m;
  std::optional<double> roll_rad, pitch_rad, heading_rad;

  static void parameters(auto& self, auto&& visit) {
    visit("position_m", "m", in(-500, 500), "position from the vehicle's reference point: forward, starboard, down",
          self.position_m);
    visit("roll_deg", "deg", in(-180, 180), "starboard side down", self.roll_rad);
    visit("pitch_deg", "deg", in(-90, 90), "bow up", self.pitch_rad);
    visit("heading_deg", "deg", in(-360, 360), "rotation to starboard", self.heading_rad);
  }
  /// What is not given is as it was.
  frames::Mounting mounting(frames::Mounting otherwise = {}) const;
};
struct HeadKeys {
  MountingKeys actual;
  std::optional<MountingKeys> measured;

  static void parameters(auto& self, auto&& visit) {
    visit("actual", "", must(any()), "position and rotation that the head truly has", self.actual);
    visit("measured", "position and rotation that the head is taken to have; left out: the actual ones", self.measured);
  }
};

/// A regular wave.
void wave_parameters(auto& wave, auto&& visit, const char* amplitude, const char* unit, double most) {
  visit(amplitude, unit, must(in(0, most)), "amplitude of the motion", wave.amplitude);
  visit("period_s", "s", in(0.2, 60), "period of the wave", wave.period_s);
  visit("phase_deg", "deg", in(-360, 360), "phase at the start", wave.phase_rad);
}
struct RollKeys : motion::Sinusoid {
  RollKeys() { period_s = 6.0; }
  static void parameters(auto& self, auto&& visit) { wave_parameters(self, visit, "amplitude_deg", "deg", 60); }
};
struct HeaveKeys : motion::Sinusoid {
  HeaveKeys() { period_s = 6.0; }
  static void parameters(auto& self, auto&& visit) { wave_parameters(self, visit, "amplitude_m", "m", 20); }
};

struct StartKeys {
  motion::State state;

  static void parameters(auto& self, auto&& visit) {
    visit("position_m", "m", must(in(-kFarAway_m, kFarAway_m)), "east, north, up from the water level",
          self.state.position_enu_m);
    visit("heading_deg", "deg", in(-360, 360), "heading at the start", self.state.heading_rad);
    visit("speed_mps", "m/s", in(0, 30), "speed at the start", self.state.speed_mps);
  }
};

struct MovesByLimits {
  static constexpr const char* kWord = "kinematic";
  static void parameters(auto&, auto&&) {}
};
struct MovesByForces {
  static constexpr const char* kWord = "hydrodynamic";
  std::string dynamics;

  static void parameters(auto& self, auto&& visit) {
    visit("dynamics", "", must(path()), "file of a hydrodynamic vehicle's forces", self.dynamics);
  }
};

struct VehicleKeys {
  std::string name;
  static constexpr auto kNamedBy = &VehicleKeys::name;
  std::variant<MovesByLimits, MovesByForces> kind;
  motion::Limits limits;
  double fastest_mps = Vehicle{}.fastest_mps;
  std::optional<RollKeys> roll;
  std::optional<HeaveKeys> heave;
  std::optional<DisturbanceKeys> disturbance;
  std::optional<LoadingKeys> floats;
  std::optional<StartKeys> start;
  std::map<std::string, HeadKeys> mountings;

  VehicleKeys() {
    limits.turn_acceleration_radps2 = 10.0 * kDegree;  // assumed: a launch has its turn in a second or two
    limits.vertical_acceleration_mps2 = 0.2;           // assumed: an AUV has its climb in two or three
  }
  static void parameters(auto& self, auto&& visit) {
    visit(form_by("kind", "moves as its limits say, or by forces as its dynamics say", "needs kind: hydrodynamic"),
          self.kind);
    visit("acceleration_mps2", "m/s^2", in(1e-3, 20), "speeding up", self.limits.acceleration_mps2);
    visit("deceleration_mps2", "m/s^2", in(1e-3, 20), "slowing down", self.limits.deceleration_mps2);
    visit("turning_radius_m", "m", in(0.1, 1000), "radius of the tightest circle", self.limits.turning_radius_m);
    visit("turn_rate_dps", "deg/s", computed(in(0.01, 360)), "fastest turn; left out: none but the circle's",
          self.limits.turn_rate_radps);
    visit("turn_acceleration_dps2", "deg/s^2", in(0.1, 10000), "acceleration with which a turn begins and ends",
          self.limits.turn_acceleration_radps2);
    visit("vertical_speed_mps", "m/s", in(1e-3, 20), "up and down", self.limits.vertical_speed_mps);
    visit("vertical_acceleration_mps2", "m/s^2", in(1e-3, 20), "acceleration with which climbs and dives begin and end",
          self.limits.vertical_acceleration_mps2);
    visit("fastest_mps", "m/s", in(0.01, 30), "speed through the water, at most", self.fastest_mps);
    visit("roll", "a regular roll", self.roll);
    visit("heave", "a regular heave", self.heave);
    visit("disturbance", "an irregular sea", self.disturbance);
    visit("floats",
          "draught and settlement of a vehicle that floats on the water level; left out: it is at the mission's depth",
          self.floats);
    visit("start", "", or_word("first_runline"), "position and heading at the start", self.start);
    visit("mountings", "heads that it carries, by their processes' names", self.mountings);
  }
  void check(const ConfigReader& from) const;
  Vehicle vehicle() const;

 private:
  static constexpr double kDegree = 3.14159265358979323846 / 180.0;
};

}  // namespace ensonify
