#include "components/vehicle/dynamics_file.h"

#include "components/config/read_parameters.h"

namespace ensonify {

using frames::Vec3;

template <>
struct ParametersOf<motion::LiftingHull> {
  static void parameters(auto& self, auto&& visit) {
    visit("span_m", "m", must(in(1e-3, 100)), "span of the lifting hull", self.span_m);
    visit("area_m2", "m^2", must(in(1e-6, 1e4)), "area of the lifting hull", self.area_m2);
    visit("drag_coefficient", "", must(in(0, 10)), "drag of the lifting hull without angle of attack, on its area",
          self.drag_coefficient);
  }
};

template <>
struct ParametersOf<motion::CrossFlow> {
  static void parameters(auto& self, auto&& visit) {
    visit("length_m", "m", must(in(1e-3, 500)), "length of the hull", self.length_m);
    visit("height_m", "m", must(in(1e-3, 100)), "height of the hull below the water", self.height_m);
    visit("coefficient", "", must(in(0, 10)), "drag coefficient of a strip, two-dimensional", self.coefficient);
  }
};

template <>
struct ParametersOf<motion::Waterplane> {
  static void parameters(auto& self, auto&& visit) {
    visit("heave_npm", "N/m", must(in(1e-3, 1e12)), "stiffness in heave", self.heave_npm);
    visit("roll_nm", "N m", must(in(0, 1e12)), "stiffness in roll, per rad", self.roll_nm);
    visit("pitch_nm", "N m", must(in(0, 1e12)), "stiffness in pitch, per rad", self.pitch_nm);
  }
};

/// Buoyancy comes from the mass where the file leaves it out.
template <>
struct ParametersOf<motion::HydrodynamicParameters> {
  static void parameters(auto& self, auto&& visit) {
    visit("density_kgpm3", "kg/m^3", in(900, 1100), "density of the water", self.density_kgpm3);
    visit("gravity_mps2", "m/s^2", in(9.7, 9.9), "acceleration of gravity", self.gravity_mps2);
    visit("mass_kg", "kg", must(in(1e-3, 1e9)), "mass of the body", self.mass_kg);
    visit("inertia_kgm2", "kg m^2", must(in(1e-9, 1e15)), "about the centre of gravity, axes along the body's",
          self.inertia_kgm2);
    visit("gravity_centre_m", "m", in(-100, 100), "centre of gravity, body frame", self.gravity_centre_body_m);
    visit("buoyancy_centre_m", "m", in(-100, 100), "centre of buoyancy, body frame", self.buoyancy_centre_body_m);
    visit("buoyancy_n", "N", computed(in(0, 1e12)), "submerged, or floating at rest; left out: the weight",
          self.buoyancy_n);
    visit("added_mass", "", in(0, 1e9), "diagonal of the added mass: kg, kg m^2", self.added_mass);
    visit("munk_moments", "", any(), "moments of the added mass in pitch and yaw that grow with speed",
          self.munk_moments);
    visit("linear_damping", "", in(0, 1e9), "diagonal of the linear damping: N per m/s, N m per rad/s",
          self.linear_damping);
    visit("damping_fade_spm", "", in(0, 1e9), "linear damping times exp(-fade * speed), s/m", self.damping_fade_spm);
    visit("quadratic_damping", "", in(0, 1e9), "diagonal of the quadratic damping: N per (m/s)^2, N m per (rad/s)^2",
          self.quadratic_damping);
    visit("lift", "lift and drag of the hull in its vertical plane", self.lift);
    visit("cross_flow", "drag of the hull in the horizontal plane, by strips", self.cross_flow);
    visit("waterplane", "springs of a floating hull; left out: submerged", self.waterplane);
  }
};

template <>
struct ParametersOf<motion::Propeller> {
  static void parameters(auto& self, auto&& visit) {
    visit("position_m", "m", in(-500, 500), "body frame", self.position_body_m);
    visit("direction", "", in(-1, 1), "direction of the thrust ahead, body frame", self.direction_body);
    visit("ahead_ns2", "", must(in(1e-9, 1e9)), "thrust ahead, N per (rev/s)^2", self.ahead_ns2);
    visit("astern_ns2", "", must(in(1e-9, 1e9)), "thrust astern, N per (rev/s)^2", self.astern_ns2);
    visit("advance_loss_ns2pm", "", in(0, 1e9), "thrust that the way takes off, N per rev/s and per m/s",
          self.advance_loss_ns2pm);
    visit("torque_nms2", "", in(-1e9, 1e9), "torque on the hull, about the direction, N m per (rev/s)^2",
          self.torque_nms2);
    visit("torque_loss_nms2pm", "", in(-1e9, 1e9), "torque that the way takes off, N m per rev/s and per m/s",
          self.torque_loss_nms2pm);
    visit("fastest_rps", "", must(in(1e-3, 1000)), "revolutions per second, at most", self.fastest_rps);
    visit("time_constant_s", "s", in(0.05, 60), "time constant of the revolutions towards what is ordered",
          self.time_constant_s);
  }
};

template <>
struct ParametersOf<motion::Fin> {
  static void parameters(auto& self, auto&& visit) {
    visit("position_m", "m", in(-500, 500), "body frame", self.position_body_m);
    visit("lift", "", in(-1, 1), "direction of the force of a positive angle, body frame", self.lift_body);
    visit("area_m2", "m^2", must(in(1e-6, 100)), "area of the fin", self.area_m2);
    visit("lift_slope", "", must(in(1e-3, 10)), "lift coefficient per rad", self.lift_slope);
    visit("largest_deg", "deg", must(in(1, 60)), "angle, at most", self.largest_rad);
    visit("time_constant_s", "s", in(0.05, 60), "time constant of the angle towards what is ordered",
          self.time_constant_s);
  }
};

template <>
struct ParametersOf<motion::HelmParameters> {
  static void parameters(auto& self, auto&& visit) {
    using Depth = motion::HelmParameters::Depth;
    visit("surge_ps", "1/s", in(1e-3, 5), "rate at which an error of speed falls", self.surge_ps);
    visit("heading_ps", "1/s", in(1e-3, 5), "rate at which an error of heading falls", self.heading_ps);
    visit("turn_rate_dps", "deg/s", in(0.1, 180), "highest ordered", self.turn_rate_radps);
    visit("depth", "", one_of({{"none", Depth::kNone}, {"by_heave", Depth::kByHeave}, {"by_pitch", Depth::kByPitch}}),
          "way to another depth: none, for it floats; thrusters push it up and down; it goes there", self.depth);
    visit("depth_ps", "1/s", in(1e-3, 5), "rate at which an error of depth falls", self.depth_ps);
    visit("climb_mps", "m/s", in(1e-3, 20), "fastest ordered climb or dive", self.climb_mps);
    visit("pitch_ps", "1/s", in(1e-3, 5), "rate at which an error of pitch falls, and of a roll kept level",
          self.pitch_ps);
    visit("steepest_deg", "deg", in(1, 80), "pitch ordered, at most; by_pitch only", self.steepest_rad);
  }
};

namespace {

struct DynamicsFile {
  HydrodynamicVehicle vehicle;

  static void parameters(auto& self, auto&& visit) {
    auto& body = self.vehicle.body;
    visit("body", "the hull: mass, added mass, damping", body);
    visit("propellers", "one or more", body.propellers);
    visit("fins", "movable fins", body.fins);
    visit("helm", "controller that steers the vehicle", self.vehicle.helm);
  }
};

void make_unit(const ConfigReader& from, const std::string& key, Vec3& direction) {
  if (direction.norm() < 0.1) return from.problem(key, "has no direction");
  direction.normalize();
}

}  // namespace

HydrodynamicVehicle read_dynamics(const std::string& path) {
  auto from = ConfigReader::from_file(path);
  DynamicsFile file;
  read_format(from, kDynamicsFormat);
  read_parameters(from, file);
  motion::HydrodynamicParameters& body = file.vehicle.body;
  const ConfigNode* hull = from.node("body");
  if (hull == nullptr) from.problem("body", "is missing; allowed: a map of keys");
  if (hull == nullptr || hull->find("buoyancy_n") == nullptr) body.buoyancy_n = body.mass_kg * body.gravity_mps2;
  const auto entry = [](const char* list, std::size_t i) { return std::string(list) + "[" + std::to_string(i) + "]."; };
  for (std::size_t i = 0; i < body.propellers.size(); ++i)
    make_unit(from, entry("propellers", i) + "direction", body.propellers[i].direction_body);
  for (std::size_t i = 0; i < body.fins.size(); ++i) make_unit(from, entry("fins", i) + "lift", body.fins[i].lift_body);
  if (body.propellers.empty()) from.problem("propellers", "are missing: nothing moves it");
  from.finish();
  return file.vehicle;
}

}  // namespace ensonify
