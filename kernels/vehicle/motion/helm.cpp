#include "kernels/vehicle/motion/helm.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ensonify::motion {
namespace {

constexpr double kDamping = 4.0;  // the inner loop is this much faster than the outer: two equal real poles

double limited(double value, double largest) { return std::clamp(value, -largest, largest); }

/// Wanted rate of the body's velocity in its own axes.
Vec6 wanted_acceleration(const HelmParameters& helm, const Body& body, const BodyState& state, const Command& command,
                         const Surroundings& around) {
  const Vec6 nu = body.through_water(state, around);
  const frames::Attitude attitude = frames::attitude_of(state.pose.enu_from_body);
  Vec6 rate = Vec6::Zero();
  rate(0) = helm.surge_ps * (command.speed_mps - nu(0));

  const double turn =
      limited(helm.heading_ps * frames::wrap_pi(command.heading_rad - attitude.heading_rad), helm.turn_rate_radps);
  rate(5) = kDamping * helm.heading_ps * (turn * std::cos(attitude.pitch_rad) - nu(5));

  const double climb_mps = limited(helm.depth_ps * (command.height_m - state.pose.position_enu_m.z()), helm.climb_mps);
  if (helm.depth == HelmParameters::Depth::kByHeave) {
    rate(2) = kDamping * helm.depth_ps * (-climb_mps - nu(2));
    rate(3) = kDamping * helm.pitch_ps * (-helm.pitch_ps * attitude.roll_rad - nu(3));
    rate(4) = kDamping * helm.pitch_ps * (-helm.pitch_ps * attitude.pitch_rad - nu(4));
  } else if (helm.depth == HelmParameters::Depth::kByPitch) {
    const double slope = limited(climb_mps / std::max(nu(0), 0.1), std::sin(helm.steepest_rad));
    const double attack = std::atan2(nu(2), std::max(nu(0), 0.1));  // the way points this much below the bow
    const double pitch_rate = helm.pitch_ps * (std::asin(slope) + attack - attitude.pitch_rad);
    rate(4) = kDamping * helm.pitch_ps * (pitch_rate - nu(4));
  }
  return rate;
}

/// The least and the most force ahead that the propellers can make at the speeds of the water along them.
std::array<double, 2> thrusts_n(const HydrodynamicParameters& p, const Vec6& through_water) {
  std::array<double, 2> least_and_most{};
  for (const Propeller& propeller : p.propellers) {
    const double along_mps = propeller.direction_body.dot(through_water.head<3>());
    const double ahead = propeller.direction_body.x() * thrust_n(propeller, propeller.fastest_rps, along_mps);
    const double astern = propeller.direction_body.x() * thrust_n(propeller, -propeller.fastest_rps, along_mps);
    least_and_most[0] += std::min(ahead, astern);
    least_and_most[1] += std::max(ahead, astern);
  }
  return least_and_most;
}

}  // namespace

Eigen::VectorXd orders(const HelmParameters& helm, const Body& body, const BodyState& state, const Command& command,
                       const Surroundings& around) {
  const HydrodynamicParameters& p = body.parameters();
  const Vec6 nu = body.through_water(state, around);
  const Vec6 passive = body.passive_force(state, around);
  Vec6 rate = wanted_acceleration(helm, body, state, command, around);
  // No speeding up that the propellers cannot make: a moment against it would pitch a body whose weight is off its
  // axis.
  const auto [least_n, most_n] = thrusts_n(p, nu);
  const double mass_kg = body.mass()(0, 0);
  rate(0) = std::clamp(rate(0), (passive(0) + least_n) / mass_kg, (passive(0) + most_n) / mass_kg);
  const Vec6 wanted = body.mass() * rate - passive;

  // Columns: force of each actuator at its largest, so that the unknowns are shares of what it can.
  Eigen::Matrix<double, 6, Eigen::Dynamic> reach(6, static_cast<Eigen::Index>(p.actuators()));
  Eigen::VectorXd along(static_cast<Eigen::Index>(p.propellers.size())), largest_n(along.size());
  Eigen::Index k = 0;
  for (const Propeller& propeller : p.propellers) {
    along(k) = propeller.direction_body.dot(nu.head<3>());
    largest_n(k) = propeller.ahead_ns2 * propeller.fastest_rps * propeller.fastest_rps;
    reach.col(k) = largest_n(k) * lever(propeller.position_body_m, propeller.direction_body);
    ++k;
  }
  for (const Fin& fin : p.fins) reach.col(k++) = fin.largest_rad * fin_force_per_rad(fin, nu, p.density_kgpm3);

  // Least squares over the steered axes, each in units of what all actuators together can do in it.
  Eigen::Matrix<double, 6, 6> pick = Eigen::Matrix<double, 6, 6>::Zero();
  const bool hovers = helm.depth == HelmParameters::Depth::kByHeave;
  const bool flies = helm.depth == HelmParameters::Depth::kByPitch;
  const std::array<bool, 6> steer{true, false, hovers, hovers, hovers || flies, true};
  for (Eigen::Index axis = 0; axis < 6; ++axis) {
    const bool steered = steer[static_cast<std::size_t>(axis)];
    const double all = reach.row(axis).cwiseAbs().sum();
    if (steered && all > 0.0) pick(axis, axis) = 1.0 / all;
  }
  const Eigen::Matrix<double, 6, Eigen::Dynamic> scaled = pick * reach;
  constexpr double kSmall = 1e-6;  // keeps shares finite where fins stand still in the water
  const Mat6 normal = scaled * scaled.transpose() + kSmall * Mat6::Identity();
  const Eigen::VectorXd share = scaled.transpose() * normal.inverse() * (pick * wanted);

  Eigen::VectorXd result(share.size());
  for (Eigen::Index i = 0; i < along.size(); ++i) {
    result(i) = revolutions_rps(p.propellers[static_cast<std::size_t>(i)], share(i) * largest_n(i), along(i));
  }
  for (Eigen::Index i = along.size(); i < share.size(); ++i) {
    result(i) = limited(share(i), 1.0) * p.fins[static_cast<std::size_t>(i - along.size())].largest_rad;
  }
  return result;
}

double top_speed_mps(const Body& body) {
  BodyState state = body.at_rest({frames::Vec3::Zero(), frames::enu_from_body({0.0, 0.0, 0.0})});
  const auto& propellers = body.parameters().propellers;
  for (std::size_t i = 0; i < propellers.size(); ++i) {
    const double ahead = propellers[i].direction_body.x();
    state.actuators(static_cast<Eigen::Index>(i)) =
        ahead < 0.0 ? -propellers[i].fastest_rps : propellers[i].fastest_rps;
  }
  double slower_mps = 0.0, faster_mps = 100.0;
  while (faster_mps - slower_mps > 1e-6) {
    const double middle_mps = 0.5 * (slower_mps + faster_mps);
    state.velocity(0) = middle_mps;
    const bool gains = body.passive_force(state, {})(0) + body.actuator_force(state, {})(0) > 0.0;
    (gains ? slower_mps : faster_mps) = middle_mps;
  }
  return slower_mps;
}

double tightest_circle_m(const HelmParameters& helm, const Body& body, double speed_mps) {
  constexpr double kStep_s = 0.02, kTurning_s = 120.0;
  BodyState state = body.at_rest({frames::Vec3::Zero(), frames::enu_from_body({0.0, 0.0, 0.0})});
  state.velocity(0) = speed_mps;
  Command command{0.0, speed_mps, 0.0};
  for (int i = 0; i < static_cast<int>(kTurning_s / kStep_s); ++i) {
    command.heading_rad = frames::attitude_of(state.pose.enu_from_body).heading_rad + 0.5 * std::numbers::pi;
    state = body.step(state, orders(helm, body, state, command, {}), {}, kStep_s);
  }
  const frames::MovingPose moving = body.moving(state, {});
  const frames::Vec3& over_ground = moving.velocity_enu_mps;
  const double rate_radps = (moving.pose.enu_from_body * moving.angular_rate_body_radps).z();
  return over_ground.head<2>().norm() / std::abs(rate_radps);
}

}  // namespace ensonify::motion
