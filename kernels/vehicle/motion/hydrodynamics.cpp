#include "kernels/vehicle/motion/hydrodynamics.h"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

namespace ensonify::motion {
namespace {

using frames::Quaternion;
using frames::Vec3;
using Mat3 = Eigen::Matrix3d;

constexpr double kOswald = 0.7;  // efficiency number of the lifting hull [Fossen2021]

Mat3 cross_matrix(const Vec3& a) {
  Mat3 s;
  s << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return s;
}

/// Mass of a rigid body about a point that the centre of gravity is `centre` away from.
Mat6 rigid_body_mass(double mass_kg, const Vec3& inertia_kgm2, const Vec3& centre) {
  const Mat3 s = cross_matrix(centre);
  Mat6 m = Mat6::Zero();
  m.topLeftCorner<3, 3>() = mass_kg * Mat3::Identity();
  m.topRightCorner<3, 3>() = -mass_kg * s;
  m.bottomLeftCorner<3, 3>() = mass_kg * s;
  m.bottomRightCorner<3, 3>() = Mat3(inertia_kgm2.asDiagonal()) - mass_kg * s * s;
  return m;
}

Vec6 joined(const Vec3& force, const Vec3& moment) {
  Vec6 both;
  both << force, moment;
  return both;
}

/// -C(nu) nu for a symmetric mass matrix: momentum seen from turning axes [Fossen2021, section 3.3].
Vec6 momentum_force(const Mat6& mass, const Vec6& nu) {
  const Vec6 momentum = mass * nu;
  const Vec3 v = nu.head<3>(), omega = nu.tail<3>(), linear = momentum.head<3>(), angular = momentum.tail<3>();
  return joined(linear.cross(omega), linear.cross(v) + angular.cross(omega));
}

/// Cross-flow drag: sums |v + x r| (v + x r) over the length, which is a parabola on either side of where the flow
/// turns; two-point Gauss integrates it, and its moment, without error.
Vec6 cross_flow_force(const CrossFlow& hull, double density_kgpm3, double v, double r) {
  const double half_m = 0.5 * hull.length_m;
  const double turning_m = r != 0.0 && std::abs(v) < std::abs(r) * half_m ? -v / r : half_m;
  double force = 0.0, moment = 0.0;
  const auto piece = [&](double from_m, double to_m) {
    const double middle = 0.5 * (from_m + to_m), reach = 0.5 * (to_m - from_m);
    for (const double x : {middle - reach / std::sqrt(3.0), middle + reach / std::sqrt(3.0)}) {
      const double flow = v + x * r;
      force += reach * std::abs(flow) * flow;
      moment += reach * std::abs(flow) * flow * x;
    }
  };
  piece(-half_m, turning_m);
  piece(turning_m, half_m);
  const double scale = -0.5 * density_kgpm3 * hull.height_m * hull.coefficient;
  return joined({0.0, scale * force, 0.0}, {0.0, 0.0, scale * moment});
}

Vec6 lifting_force(const LiftingHull& hull, double density_kgpm3, const Vec6& nu) {
  const double aspect = hull.span_m * hull.span_m / hull.area_m2;
  const double attack = std::atan2(nu(2), nu(0));
  const double slope = M_PI * aspect / (1.0 + std::sqrt(1.0 + 0.25 * aspect * aspect));
  const double lift = slope * attack;
  const double drag = hull.drag_coefficient + lift * lift / (M_PI * kOswald * aspect);
  const double pressure = 0.5 * density_kgpm3 * nu.head<3>().squaredNorm() * hull.area_m2;
  const double s = std::sin(attack), c = std::cos(attack);
  return joined({pressure * (lift * s - drag * c), 0.0, -pressure * (lift * c + drag * s)}, Vec3::Zero());
}

void check(const HydrodynamicParameters& p) {
  const auto must = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(std::string("hydrodynamics: ") + what);
  };
  const auto unit = [](const Vec3& v) { return std::abs(v.norm() - 1.0) < 1e-6; };
  must(p.mass_kg > 0.0 && p.density_kgpm3 > 0.0 && p.gravity_mps2 > 0.0, "mass, density and gravity must be above 0");
  must(p.inertia_kgm2.minCoeff() > 0.0, "moments of inertia must be above 0");
  must(p.added_mass.minCoeff() >= 0.0 && p.linear_damping.minCoeff() >= 0.0 && p.quadratic_damping.minCoeff() >= 0.0 &&
           p.damping_fade_spm.minCoeff() >= 0.0,
       "added mass and damping must be 0 or more");
  must(!p.lift || (p.lift->span_m > 0.0 && p.lift->area_m2 > 0.0), "a lifting hull needs a span and an area");
  for (const Propeller& propeller : p.propellers) {
    must(unit(propeller.direction_body), "a propeller's direction must be of unit length");
    must(propeller.ahead_ns2 > 0.0 && propeller.astern_ns2 > 0.0 && propeller.fastest_rps > 0.0 &&
             propeller.time_constant_s > 0.0,
         "a propeller's thrusts, revolutions and time constant must be above 0");
  }
  for (const Fin& fin : p.fins) {
    must(unit(fin.lift_body), "a fin's lift must be of unit length");
    must(fin.area_m2 > 0.0 && fin.lift_slope > 0.0 && fin.largest_rad > 0.0 && fin.time_constant_s > 0.0,
         "a fin's area, lift slope, largest angle and time constant must be above 0");
  }
}

}  // namespace

/// Rates of everything in a BodyState.
struct Body::Slope {
  Vec3 position;
  Eigen::Vector4d quaternion;
  Vec6 velocity;
  Eigen::VectorXd actuators;
};

Body::Body(const HydrodynamicParameters& parameters) : parameters_(parameters) {
  check(parameters);
  body_mass_ = rigid_body_mass(parameters.mass_kg, parameters.inertia_kgm2, parameters.gravity_centre_body_m);
  mass_ = body_mass_;
  mass_.diagonal() += parameters.added_mass;
  inverse_mass_ = mass_.inverse();
}

BodyState Body::at_rest(const frames::Pose& pose) const {
  return {pose, Vec6::Zero(), Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters_.actuators()))};
}

Vec6 Body::through_water(const BodyState& state, const Surroundings& around) const {
  Vec6 nu = state.velocity;
  nu.head<3>() -= state.pose.enu_from_body.conjugate() * around.current_enu_mps;
  return nu;
}

Vec6 Body::coriolis_force(const Vec6& nu) const {
  Vec6 force = momentum_force(body_mass_, nu);
  if (parameters_.munk_moments) return force + momentum_force(parameters_.added_mass.asDiagonal(), nu);
  // Without the columns that pitch and yaw share with the linear velocities, and their mirror rows: still no work.
  const Vec6 momentum = parameters_.added_mass.cwiseProduct(nu);
  const Vec3 linear = momentum.head<3>(), angular = momentum.tail<3>(), omega = nu.tail<3>();
  force.head<3>() += linear.cross(Vec3(omega.x(), 0.0, 0.0));
  force.tail<3>() += angular.cross(omega);
  force(3) += linear.cross(Vec3(nu.head<3>())).x();
  return force;
}

Vec6 Body::hull_force(const Vec6& nu) const {
  const HydrodynamicParameters& p = parameters_;
  const double speed = nu.head<3>().norm();
  Vec6 force = Vec6::Zero();
  for (int i = 0; i < 6; ++i) {
    force(i) =
        -(p.linear_damping(i) * std::exp(-p.damping_fade_spm(i) * speed) + p.quadratic_damping(i) * std::abs(nu(i))) *
        nu(i);
  }
  if (p.lift) force += lifting_force(*p.lift, p.density_kgpm3, nu);
  if (p.cross_flow) force += cross_flow_force(*p.cross_flow, p.density_kgpm3, nu(1), nu(5));
  return force;
}

Vec6 Body::restoring_force(const frames::Pose& pose, double water_level_m) const {
  const HydrodynamicParameters& p = parameters_;
  const Vec3 down = pose.enu_from_body.conjugate() * -Vec3::UnitZ();
  const Vec3 weight = p.mass_kg * p.gravity_mps2 * down, buoyancy = -p.buoyancy_n * down;
  Vec6 force =
      joined(weight + buoyancy, p.gravity_centre_body_m.cross(weight) + p.buoyancy_centre_body_m.cross(buoyancy));
  if (p.waterplane) {
    const frames::Attitude attitude = frames::attitude_of(pose.enu_from_body);
    const double lift_n = -p.waterplane->heave_npm * (pose.position_enu_m.z() - water_level_m);
    force.head<3>() -= lift_n * down;
    force(3) -= p.waterplane->roll_nm * attitude.roll_rad;
    force(4) -= p.waterplane->pitch_nm * attitude.pitch_rad;
  }
  return force;
}

Vec6 Body::passive_force(const BodyState& state, const Surroundings& around) const {
  const Vec6 nu = through_water(state, around);
  return coriolis_force(nu) + hull_force(nu) + restoring_force(state.pose, around.water_level_m);
}

Vec6 Body::actuator_force(const BodyState& state, const Surroundings& around) const {
  const Vec6 nu = through_water(state, around);
  Vec6 force = Vec6::Zero();
  Eigen::Index k = 0;
  for (const Propeller& propeller : parameters_.propellers) {
    const double rps = state.actuators(k++), along = propeller.direction_body.dot(nu.head<3>());
    force += thrust_n(propeller, rps, along) * lever(propeller.position_body_m, propeller.direction_body);
    force.tail<3>() += torque_nm(propeller, rps, along) * propeller.direction_body;
  }
  for (const Fin& fin : parameters_.fins) {
    const double angle = state.actuators(k++);
    const Vec6 per_rad = fin_force_per_rad(fin, nu, parameters_.density_kgpm3);
    force += per_rad * angle;
    force(0) -= per_rad.head<3>().norm() * angle * angle;
  }
  return force;
}

Vec6 Body::acceleration(const BodyState& state, const Surroundings& around) const {
  Vec6 rate = inverse_mass_ * (passive_force(state, around) + actuator_force(state, around));
  // The current stands still in the world and turns in the body's axes.
  const Vec3 current_body = state.pose.enu_from_body.conjugate() * around.current_enu_mps;
  rate.head<3>() += current_body.cross(Vec3(state.velocity.tail<3>()));
  return rate;
}

Body::Slope Body::slope(const BodyState& state, const Eigen::VectorXd& orders, const Surroundings& around) const {
  const Quaternion& q = state.pose.enu_from_body;
  const Vec6& nu = state.velocity;
  Slope d;
  d.position = q.normalized() * Vec3(nu.head<3>());
  d.quaternion = 0.5 * (q * Quaternion(0.0, nu(3), nu(4), nu(5))).coeffs();
  d.velocity = acceleration(state, around);
  d.actuators.resize(state.actuators.size());
  Eigen::Index k = 0;
  const auto follow = [&](double largest, double time_constant_s) {
    const double order = std::min(std::max(orders(k), -largest), largest);
    d.actuators(k) = (order - state.actuators(k)) / time_constant_s;
    ++k;
  };
  for (const Propeller& propeller : parameters_.propellers) follow(propeller.fastest_rps, propeller.time_constant_s);
  for (const Fin& fin : parameters_.fins) follow(fin.largest_rad, fin.time_constant_s);
  return d;
}

BodyState Body::step(const BodyState& state, const Eigen::VectorXd& orders, const Surroundings& around,
                     double dt_s) const {
  const auto moved = [](const BodyState& from, const Slope& d, double h) {
    BodyState to = from;
    to.pose.position_enu_m += h * d.position;
    to.pose.enu_from_body.coeffs() += h * d.quaternion;
    to.velocity += h * d.velocity;
    to.actuators += h * d.actuators;
    return to;
  };
  const Slope k1 = slope(state, orders, around);
  const Slope k2 = slope(moved(state, k1, 0.5 * dt_s), orders, around);
  const Slope k3 = slope(moved(state, k2, 0.5 * dt_s), orders, around);
  const Slope k4 = slope(moved(state, k3, dt_s), orders, around);
  BodyState next = moved(moved(moved(moved(state, k1, dt_s / 6), k2, dt_s / 3), k3, dt_s / 3), k4, dt_s / 6);
  next.pose.enu_from_body = frames::canonical(next.pose.enu_from_body);
  return next;
}

frames::MovingPose Body::moving(const BodyState& state, const Surroundings& around) const {
  const Vec6 rate = acceleration(state, around);
  const Vec3 v = state.velocity.head<3>(), omega = state.velocity.tail<3>();
  frames::MovingPose moving;
  moving.pose = state.pose;
  moving.velocity_enu_mps = state.pose.enu_from_body * v;
  moving.angular_rate_body_radps = omega;
  moving.acceleration_enu_mps2 = state.pose.enu_from_body * (rate.head<3>() + omega.cross(v));
  moving.angular_acceleration_body_radps2 = rate.tail<3>();
  return moving;
}

double thrust_n(const Propeller& propeller, double rps, double water_speed_mps) {
  if (rps <= 0.0) return -propeller.astern_ns2 * rps * rps;
  return propeller.ahead_ns2 * rps * rps - propeller.advance_loss_ns2pm * rps * water_speed_mps;
}

double torque_nm(const Propeller& propeller, double rps, double water_speed_mps) {
  if (rps <= 0.0) return -propeller.torque_nms2 * rps * rps;
  return propeller.torque_nms2 * rps * rps - propeller.torque_loss_nms2pm * rps * water_speed_mps;
}

double revolutions_rps(const Propeller& propeller, double thrust_n, double water_speed_mps) {
  if (thrust_n < 0.0) return std::max(-propeller.fastest_rps, -std::sqrt(-thrust_n / propeller.astern_ns2));
  const double half_loss = 0.5 * propeller.advance_loss_ns2pm * water_speed_mps;
  const double root = std::sqrt(half_loss * half_loss + propeller.ahead_ns2 * thrust_n);
  return std::min(propeller.fastest_rps, std::max(0.0, (half_loss + root) / propeller.ahead_ns2));
}

Vec6 lever(const Vec3& position_body_m, const Vec3& direction_body) {
  return joined(direction_body, position_body_m.cross(direction_body));
}

Vec6 fin_force_per_rad(const Fin& fin, const Vec6& through_water, double density_kgpm3) {
  const double across = fin.lift_body.dot(through_water.head<3>());
  const double pressure = 0.5 * density_kgpm3 * (through_water(0) * through_water(0) + across * across);
  return pressure * fin.area_m2 * fin.lift_slope * lever(fin.position_body_m, fin.lift_body);
}

AddedMassShares spheroid_added_mass(double length_m, double diameter_m) {
  if (!(diameter_m > 0.0 && length_m >= diameter_m)) {
    throw std::invalid_argument("spheroid_added_mass: the diameter must be above 0 and the length not below it");
  }
  const double e2 = 1.0 - diameter_m * diameter_m / (length_m * length_m);
  if (e2 < 1e-6) return {0.5, 0.5, 0.0};
  const double e = std::sqrt(e2), e3 = e * e2, log = std::log((1.0 + e) / (1.0 - e));
  const double alpha = 2.0 * (1.0 - e2) / e3 * (0.5 * log - e);
  const double beta = 1.0 / e2 - (1.0 - e2) / (2.0 * e3) * log;
  const double turning = e2 * e2 * (beta - alpha) / ((2.0 - e2) * (2.0 * e2 - (2.0 - e2) * (beta - alpha)));
  return {alpha / (2.0 - alpha), beta / (2.0 - beta), turning};
}

}  // namespace ensonify::motion
