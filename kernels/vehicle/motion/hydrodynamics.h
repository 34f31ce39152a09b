#pragma once

#include <optional>
#include <vector>

#include "kernels/base/frames/pose.h"

/// Forces and motion of a body in water, six degrees of freedom [Fossen2021].
///
/// In the body's frame (forward, starboard, down) about its reference point, with nu = (u v w p q r) and nu_r = nu less
/// the current:  M nu_r' + C(nu_r) nu_r + D(nu_r) nu_r + g(pose) = tau. M and C are those of the body and of the water
/// that it carries with it; the current is steady and without shear over the body. Waves are not in here: they are
/// superimposed on the pose (excursion.h).
namespace ensonify::motion {

using Vec6 = Eigen::Matrix<double, 6, 1>;  // force and moment, or linear and angular velocity
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// A screw, in a duct or not. Thrust n |n| times a coefficient, less what the water's own way takes off when ahead: the
/// thrust coefficient of an open-water diagram as a straight line of the advance number.
struct Propeller {
  frames::Vec3 position_body_m = frames::Vec3::Zero();
  frames::Vec3 direction_body = frames::Vec3::UnitX();  // of the thrust ahead, unit length
  double ahead_ns2 = 0.0;                               // N per (rev/s)^2, > 0
  double astern_ns2 = 0.0;                              // N per (rev/s)^2, > 0
  double advance_loss_ns2pm = 0.0;                      // N per rev/s and per m/s of water speed, >= 0
  double torque_nms2 = 0.0;                             // on the hull, about `direction_body`, N m per (rev/s)^2
  double torque_loss_nms2pm = 0.0;                      // the same line for the torque, >= 0
  double fastest_rps = 0.0;                             // rev/s, > 0
  double time_constant_s = 1.0;                         // of the revolutions towards what is ordered, > 0
};

/// A movable fin: lift in proportion to its angle and drag in proportion to the angle's square.
struct Fin {
  frames::Vec3 position_body_m = frames::Vec3::Zero();
  frames::Vec3 lift_body = frames::Vec3::UnitY();  // of the force of a positive angle, unit length, across the hull
  double area_m2 = 0.0;
  double lift_slope = 0.0;  // lift coefficient per rad
  double largest_rad = 0.5;
  double time_constant_s = 0.1;  // > 0
};

/// Lift and drag of the hull in its vertical plane, as of a wing of low aspect ratio [Beard2012].
struct LiftingHull {
  double span_m = 0.0;
  double area_m2 = 0.0;
  double drag_coefficient = 0.0;  // without angle of attack, on `area_m2`
};

/// Cross-flow drag of the hull in the horizontal plane by strips [Faltinsen1990].
struct CrossFlow {
  double length_m = 0.0;
  double height_m = 0.0;
  double coefficient = 0.0;  // of a strip, two-dimensional
};

/// Forces of the water's surface on a floating hull: springs for small motions about the waterline at rest.
struct Waterplane {
  double heave_npm = 0.0;  // rho g A
  double roll_nm = 0.0;    // rho g times the second moment of the area about its fore-and-aft axis, N m per rad
  double pitch_nm = 0.0;
};

struct HydrodynamicParameters {
  double density_kgpm3 = 1026.0;  // of the water
  double gravity_mps2 = 9.81;
  double mass_kg = 0.0;
  frames::Vec3 inertia_kgm2 = frames::Vec3::Zero();  // about the centre of gravity, principal axes along the body's
  frames::Vec3 gravity_centre_body_m = frames::Vec3::Zero();
  double buoyancy_n = 0.0;  // submerged, or of a floating hull at rest
  frames::Vec3 buoyancy_centre_body_m = frames::Vec3::Zero();

  Vec6 added_mass = Vec6::Zero();  // the diagonal: kg, kg m^2; positive
  /// The moments of the added mass in pitch and yaw that grow with speed and turn a hull across its way. They need
  /// damping that grows too; models whose damping in pitch and yaw is linear leave them out.
  bool munk_moments = true;
  Vec6 linear_damping = Vec6::Zero();     // the diagonal: N per m/s, N m per rad/s; positive
  Vec6 damping_fade_spm = Vec6::Zero();   // linear damping times exp(-fade * speed): skin friction at low speed only
  Vec6 quadratic_damping = Vec6::Zero();  // N per (m/s)^2, N m per (rad/s)^2; positive
  std::optional<LiftingHull> lift;
  std::optional<CrossFlow> cross_flow;
  std::optional<Waterplane> waterplane;  // not given: submerged
  std::vector<Propeller> propellers;
  std::vector<Fin> fins;

  std::size_t actuators() const { return propellers.size() + fins.size(); }
};

/// Water about the body: the same for all of it.
struct Surroundings {
  frames::Vec3 current_enu_mps = frames::Vec3::Zero();
  double water_level_m = 0.0;  // up from the world's zero; a floating body's reference point rests on it
};

struct BodyState {
  frames::Pose pose;
  Vec6 velocity = Vec6::Zero();  // over ground, body frame
  Eigen::VectorXd actuators;     // propellers in rev/s, then fins in rad
};

class Body {
 public:
  /// Throws std::invalid_argument for masses, inertias or limits that are not above 0, negative damping, or directions
  /// that are not of unit length.
  explicit Body(const HydrodynamicParameters& parameters);

  const HydrodynamicParameters& parameters() const { return parameters_; }
  const Mat6& mass() const { return mass_; }  // of the body and the water it carries

  /// At a place, at rest through the water, actuators at zero.
  BodyState at_rest(const frames::Pose& pose) const;

  /// All forces and moments but those of propellers and fins, and the inertial ones of turning axes.
  Vec6 passive_force(const BodyState& state, const Surroundings& around) const;
  /// Forces and moments of propellers and fins as they stand.
  Vec6 actuator_force(const BodyState& state, const Surroundings& around) const;
  /// Rate of `velocity`.
  Vec6 acceleration(const BodyState& state, const Surroundings& around) const;
  /// Velocity through the water, body frame.
  Vec6 through_water(const BodyState& state, const Surroundings& around) const;

  /// One step of Runge and Kutta's method of fourth order. Actuators follow their orders (clamped to what they can)
  /// with their time constants. A step of 20 ms holds for time constants and periods down to 0.1 s.
  BodyState step(const BodyState& state, const Eigen::VectorXd& orders, const Surroundings& around, double dt_s) const;

  /// Pose, velocity, acceleration and turn rates in the world.
  frames::MovingPose moving(const BodyState& state, const Surroundings& around) const;

 private:
  struct Slope;
  Slope slope(const BodyState& state, const Eigen::VectorXd& orders, const Surroundings& around) const;
  Vec6 coriolis_force(const Vec6& through_water) const;
  Vec6 hull_force(const Vec6& through_water) const;
  Vec6 restoring_force(const frames::Pose& pose, double water_level_m) const;

  HydrodynamicParameters parameters_;
  Mat6 body_mass_, mass_, inverse_mass_;
};

/// Thrust and torque of a propeller; the water speed is that along its direction.
double thrust_n(const Propeller& propeller, double rps, double water_speed_mps);
double torque_nm(const Propeller& propeller, double rps, double water_speed_mps);

/// Revolutions for a thrust, within what the propeller can.
double revolutions_rps(const Propeller& propeller, double thrust_n, double water_speed_mps);

/// Force and moment about the reference point of a unit force along `direction` at `position`.
Vec6 lever(const frames::Vec3& position_body_m, const frames::Vec3& direction_body);

/// Force of a fin per rad of its angle at a velocity through the water, without its drag.
Vec6 fin_force_per_rad(const Fin& fin, const Vec6& through_water, double density_kgpm3);

/// Added mass of a prolate spheroid along its axis and across it, and about a cross axis, by Lamb's factors [Lamb1932]:
/// as shares of the displaced mass and of its moment of inertia. A sphere gives 1/2, 1/2, 0. length >= diameter > 0.
struct AddedMassShares {
  double along, across, turning;
};
AddedMassShares spheroid_added_mass(double length_m, double diameter_m);

}  // namespace ensonify::motion
