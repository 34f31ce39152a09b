#include "components/vehicle/hydrodynamic/dynamics_file.h"

#include <stdexcept>

#include "components/config/config_reader.h"
#include "scenarios/world/world.h"

namespace ensonify {
namespace {

using frames::Vec3;

void read_vec3(ConfigReader& from, const char* key, Vec3& value, double most) {
  std::array<double, 3> numbers{value.x(), value.y(), value.z()};
  from.optional(key, numbers, -most, most);
  value = {numbers[0], numbers[1], numbers[2]};
}

void read_direction(ConfigReader& from, const char* key, Vec3& value) {
  read_vec3(from, key, value, 1.0);
  if (value.norm() < 0.1) return from.problem(key, "has no direction");
  value.normalize();
}

void read_six(ConfigReader& from, const char* key, motion::Vec6& value) {
  std::array<double, 6> numbers{};
  from.optional(key, numbers, 0, 1e9);
  value = Eigen::Map<const motion::Vec6>(numbers.data());
}

void read_hull(ConfigReader& from, motion::HydrodynamicParameters& p) {
  if (auto section = from.optional_section("lift")) {
    p.lift.emplace();
    section->required("span_m", p.lift->span_m, 1e-3, 100);
    section->required("area_m2", p.lift->area_m2, 1e-6, 1e4);
    section->required("drag_coefficient", p.lift->drag_coefficient, 0, 10);
  }
  if (auto section = from.optional_section("cross_flow")) {
    p.cross_flow.emplace();
    section->required("length_m", p.cross_flow->length_m, 1e-3, 500);
    section->required("height_m", p.cross_flow->height_m, 1e-3, 100);
    section->required("coefficient", p.cross_flow->coefficient, 0, 10);
  }
  if (auto section = from.optional_section("waterplane")) {
    p.waterplane.emplace();
    section->required("heave_npm", p.waterplane->heave_npm, 1e-3, 1e12);
    section->required("roll_nm", p.waterplane->roll_nm, 0, 1e12);
    section->required("pitch_nm", p.waterplane->pitch_nm, 0, 1e12);
  }
}

void read_body(ConfigReader from, motion::HydrodynamicParameters& p) {
  from.optional("density_kgpm3", p.density_kgpm3, 900, 1100);
  from.optional("gravity_mps2", p.gravity_mps2, 9.7, 9.9);
  from.required("mass_kg", p.mass_kg, 1e-3, 1e9);
  std::array<double, 3> inertia{};
  from.required("inertia_kgm2", inertia, 1e-9, 1e15);
  p.inertia_kgm2 = {inertia[0], inertia[1], inertia[2]};
  read_vec3(from, "gravity_centre_m", p.gravity_centre_body_m, 100);
  read_vec3(from, "buoyancy_centre_m", p.buoyancy_centre_body_m, 100);
  p.buoyancy_n = p.mass_kg * p.gravity_mps2;
  from.optional("buoyancy_n", p.buoyancy_n, 0, 1e12);
  read_six(from, "added_mass", p.added_mass);
  from.optional("munk_moments", p.munk_moments);
  read_six(from, "linear_damping", p.linear_damping);
  read_six(from, "damping_fade_spm", p.damping_fade_spm);
  read_six(from, "quadratic_damping", p.quadratic_damping);
  read_hull(from, p);
}

motion::Propeller read_propeller(ConfigReader& from) {
  motion::Propeller propeller;
  read_vec3(from, "position_m", propeller.position_body_m, 500);
  read_direction(from, "direction", propeller.direction_body);
  from.required("ahead_ns2", propeller.ahead_ns2, 1e-9, 1e9);
  from.required("astern_ns2", propeller.astern_ns2, 1e-9, 1e9);
  from.optional("advance_loss_ns2pm", propeller.advance_loss_ns2pm, 0, 1e9);
  from.optional("torque_nms2", propeller.torque_nms2, -1e9, 1e9);
  from.optional("torque_loss_nms2pm", propeller.torque_loss_nms2pm, -1e9, 1e9);
  from.required("fastest_rps", propeller.fastest_rps, 1e-3, 1000);
  from.optional("time_constant_s", propeller.time_constant_s, 0.05, 60);
  return propeller;
}

motion::Fin read_fin(ConfigReader& from) {
  motion::Fin fin;
  read_vec3(from, "position_m", fin.position_body_m, 500);
  read_direction(from, "lift", fin.lift_body);
  from.required("area_m2", fin.area_m2, 1e-6, 100);
  from.required("lift_slope", fin.lift_slope, 1e-3, 10);
  from.required("largest_deg", fin.largest_rad, 1, 60, kDegrees);
  from.optional("time_constant_s", fin.time_constant_s, 0.05, 60);
  return fin;
}

motion::HelmParameters read_helm(ConfigReader from) {
  using Depth = motion::HelmParameters::Depth;
  motion::HelmParameters helm;
  from.optional("surge_ps", helm.surge_ps, 1e-3, 5);
  from.optional("heading_ps", helm.heading_ps, 1e-3, 5);
  from.optional("turn_rate_dps", helm.turn_rate_radps, 0.1, 180, kDegrees);
  from.optional_choice("depth", helm.depth,
                       {{"none", Depth::kNone}, {"by_heave", Depth::kByHeave}, {"by_pitch", Depth::kByPitch}});
  from.optional("depth_ps", helm.depth_ps, 1e-3, 5);
  from.optional("climb_mps", helm.climb_mps, 1e-3, 20);
  from.optional("pitch_ps", helm.pitch_ps, 1e-3, 5);
  from.optional("steepest_deg", helm.steepest_rad, 1, 80, kDegrees);
  return helm;
}

}  // namespace

HydrodynamicVehicle read_dynamics(const std::string& path) {
  auto from = ConfigReader::from_file(path);
  HydrodynamicVehicle vehicle;
  read_format(from, kDynamicsFormat);
  read_body(from.section("body"), vehicle.body);
  for (auto& item : from.list("propellers")) vehicle.body.propellers.push_back(read_propeller(item));
  for (auto& item : from.list("fins")) vehicle.body.fins.push_back(read_fin(item));
  if (const auto helm = from.optional_section("helm")) vehicle.helm = read_helm(*helm);
  if (vehicle.body.propellers.empty()) from.problem("propellers", "are missing: nothing moves it");
  from.finish();
  return vehicle;
}

}  // namespace ensonify
