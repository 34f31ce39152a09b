#include "kernels/instruments/inertial/imu.h"

#include <cmath>

namespace ensonify::inertial {
namespace {

enum Lane : std::uint64_t { kFixed = 0, kWhite = 3, kWander = 6, kWalk = 9 };  // and the axis, 0..2

Eigen::Matrix3d drawn_errors(const TriadErrors& errors, const random::Stream& stream) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const double sigma = row == column ? errors.scale_factor : errors.misalignment_rad;
      matrix(row, column) += sigma * stream.normal(static_cast<std::uint64_t>(1 + 3 * row + column), kFixed);
    }
  }
  return matrix;
}

}  // namespace

Triad::Triad(const TriadErrors& errors, const random::Stream& stream)
    : errors_(errors), stream_(stream), sensed_from_true_(drawn_errors(errors, stream)) {
  for (std::uint64_t axis = 0; axis < 3; ++axis) {
    turn_on_[static_cast<Eigen::Index>(axis)] = errors.turn_on_bias * stream.normal(0, kFixed + axis);
    wandering_[axis] = random::GaussMarkov(errors.bias_sigma, errors.bias_time_s, stream, kWander + axis);
  }
}

frames::Vec3 Triad::bias() const {
  return turn_on_ + walk_ + frames::Vec3(wandering_[0].value(), wandering_[1].value(), wandering_[2].value());
}

frames::Vec3 Triad::increment(const frames::Vec3& true_mean, double dt_s) {
  ++n_;
  frames::Vec3 reported = unreported_ + dt_s * (sensed_from_true_ * true_mean + bias());
  const double root_dt = std::sqrt(dt_s);
  for (std::uint64_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    reported[i] += errors_.random_walk * root_dt * stream_.normal(n_, kWhite + axis);
    walk_[i] += errors_.rate_random_walk * root_dt * stream_.normal(n_, kWalk + axis);
    wandering_[axis].advance(dt_s, stream_, n_, kWander + axis);
    if (errors_.quantum > 0.0) {
      const double whole = errors_.quantum * std::floor(reported[i] / errors_.quantum);
      unreported_[i] = reported[i] - whole;
      reported[i] = whole;
    }
  }
  return reported;
}

}  // namespace ensonify::inertial
