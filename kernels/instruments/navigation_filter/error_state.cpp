#include "kernels/instruments/navigation_filter/error_state.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace ensonify::navigation_filter {
namespace {

using Eigen::Matrix3d;
using inertial::meridian_radius_m;
using inertial::prime_vertical_radius_m;

constexpr double kCovarianceStep_s = 0.1;

Matrix3d cross(const Vec3& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

double squared(double x) { return x * x; }

/// Variance of one axis's bias at the start: of switching on and of wandering.
double first_bias_variance(const inertial::TriadErrors& errors) {
  return squared(errors.turn_on_bias) + squared(errors.bias_sigma);
}

/// Variances of scale and crosstalk of three sensors, row by row.
Eigen::Matrix<double, 9, 1> matrix_variances(const inertial::TriadErrors& errors) {
  Matrix3d of = Matrix3d::Constant(squared(errors.misalignment_rad));
  of.diagonal().setConstant(squared(errors.scale_factor));
  return of.reshaped();  // symmetric
}

/// Spectral density of what drives one axis's bias.
double bias_drive(const inertial::TriadErrors& errors) {
  return 2.0 * squared(errors.bias_sigma) / errors.bias_time_s + squared(errors.rate_random_walk);
}

/// What a compass's error at a heading is made of: [Bowditch, ch. 6], A to E.
Eigen::Matrix<double, 5, 1> deviation_shape(double heading_rad) {
  return {1.0, std::sin(heading_rad), std::cos(heading_rad), std::sin(2.0 * heading_rad), std::cos(2.0 * heading_rad)};
}

}  // namespace

NavigationFilter::NavigationFilter(const NavigationState& start, const StartErrors& errors, const FilterModel& model,
                                   const inertial::Earth& earth)
    : earth_(earth), model_(model), state_(start) {
  Eigen::Matrix<double, kErrorCount, 1> variance;
  variance.segment<3>(kPosition) << squared(errors.position_m), squared(errors.position_m), squared(errors.height_m);
  variance.segment<3>(kVelocity).setConstant(squared(errors.velocity_mps));
  variance.segment<3>(kRotation) << squared(errors.tilt_rad), squared(errors.tilt_rad), squared(errors.heading_rad);
  variance.segment<3>(kGyroBias).setConstant(first_bias_variance(model.imu.gyro));
  variance.segment<9>(kGyroMatrix) = matrix_variances(model.imu.gyro);
  variance.segment<3>(kForceBias).setConstant(first_bias_variance(model.imu.accelerometer));
  variance.segment<9>(kForceMatrix) = matrix_variances(model.imu.accelerometer);
  const double wander = squared(model.fix_wander_horizontal_m);
  variance.segment<3>(kFixError) << wander, wander, squared(model.fix_wander_vertical_m);
  variance[kLogScale] = squared(model.log_scale);
  variance.segment<2>(kCurrent).setConstant(squared(model.current_mps));
  variance.segment<3>(kCarrier).setOnes();
  variance[kLevel] = squared(model.level_wander_m);
  variance[kCompassWander] = squared(model.compass_wander_rad);
  for (int i = 0; i < 5; ++i) variance[kCompassDeviation + i] = squared(model.compass_deviation_rad[i]);
  covariance_.diagonal() = variance;
  remember();
}

void NavigationFilter::propagate(const inertial::Inertial& measured, double dt_s) {
  const inertial::Inertial corrected{measured.rate_radps - gyro_bias_ - gyro_matrix_ * measured.rate_radps,
                                     measured.force_mps2 - force_bias_ - force_matrix_ * measured.force_mps2};
  const frames::Quaternion before = state_.ned_from_body;
  state_ = inertial::advance(state_, corrected, dt_s, earth_);
  if (interval_s_ > 0.0) rate_growth_radps_ = dt_s / (dt_s + interval_s_) * (corrected.rate_radps - rate_radps_);
  rate_radps_ = corrected.rate_radps;
  interval_s_ = dt_s;
  pending_turn_rad_ += dt_s * corrected.rate_radps;
  pending_velocity_ned_ += dt_s * (before.slerp(0.5, state_.ned_from_body) * corrected.force_mps2);
  pending_s_ += dt_s;
  fix_error_ *= std::exp(-dt_s / model_.fix_wander_s);
  carrier_error_ *= std::exp(-dt_s / model_.carrier_s);
  level_error_m_ *= std::exp(-dt_s / model_.level_wander_s);
  compass_wander_rad_ *= std::exp(-dt_s / model_.compass_wander_s);
  t_s_ += dt_s;
  if (pending_s_ < kCovarianceStep_s - 1e-9) return;
  propagate_covariance();
  remember();
}

void NavigationFilter::remember() {
  if (model_.remembered_s <= 0.0) return;
  past_.push_back({t_s_, state_});
  while (past_.size() > 1 && past_[1].t_s <= t_s_ - model_.remembered_s) past_.pop_front();
}

std::optional<NavigationState> NavigationFilter::recall(double age_s) const {
  if (age_s <= 0.0) return state_;
  const double t_s = t_s_ - age_s;
  if (past_.empty() || t_s < past_.front().t_s) return std::nullopt;
  const auto after = std::ranges::upper_bound(past_, t_s, {}, &Past::t_s);
  const Past& before = *std::prev(after);
  const Past next = after == past_.end() ? Past{t_s_, state_} : *after;
  const double share = next.t_s > before.t_s ? (t_s - before.t_s) / (next.t_s - before.t_s) : 0.0;
  const auto between = [share](const auto& from, const auto& to) { return from + share * (to - from); };
  const NavigationState &a = before.state, &b = next.state;
  NavigationState then = b;
  then.latitude_rad = between(a.latitude_rad, b.latitude_rad);
  then.longitude_rad =
      a.longitude_rad + share * std::remainder(b.longitude_rad - a.longitude_rad, 2.0 * std::numbers::pi);
  then.height_m = between(a.height_m, b.height_m);
  then.velocity_ned_mps += (share - 1.0) * (b.velocity_ned_mps - a.velocity_ned_mps);
  then.ned_from_body = a.ned_from_body.slerp(share, b.ned_from_body);
  return then;
}

/// F of dx/dt = F x: [Groves2013, sec. 14.2.4] with the signs of truth less estimate.
Covariance NavigationFilter::error_rates(const Vec3& force_ned, const Vec3& rate_body_radps) const {
  const double latitude = state_.latitude_rad;
  const double north_m = meridian_radius_m(earth_, latitude) + state_.height_m;
  const double east_m = prime_vertical_radius_m(earth_, latitude) + state_.height_m;
  const Matrix3d ned_from_body = state_.ned_from_body.toRotationMatrix();
  const Vec3 force_body = ned_from_body.transpose() * force_ned;
  const Vec3 earth_rate = inertial::earth_rate_ned_radps(state_, earth_);
  const Vec3 transport = inertial::transport_rate_ned_radps(state_, earth_);

  Covariance f = Covariance::Zero();
  f.block<3, 3>(kPosition, kVelocity).setIdentity();
  f.block<3, 3>(kVelocity, kVelocity) = -cross(2.0 * earth_rate + transport);
  f.block<3, 3>(kVelocity, kRotation) = -cross(force_ned);
  f.block<3, 3>(kVelocity, kForceBias) = -ned_from_body;
  f(kVelocity + 2, kPosition + 2) =
      2.0 * inertial::gravity_mps2(earth_, latitude, state_.height_m) / earth_.equatorial_radius_m;

  f.block<3, 3>(kRotation, kRotation) = -cross(earth_rate + transport);
  f.block<3, 3>(kRotation, kGyroBias) = -ned_from_body;
  for (int row = 0; row < 3; ++row) {
    f.block<3, 3>(kRotation, kGyroMatrix + 3 * row) = -ned_from_body.col(row) * rate_body_radps.transpose();
    f.block<3, 3>(kVelocity, kForceMatrix + 3 * row) = -ned_from_body.col(row) * force_body.transpose();
  }
  f(kRotation, kVelocity + 1) = -1.0 / east_m;
  f(kRotation + 1, kVelocity) = 1.0 / north_m;
  f(kRotation + 2, kVelocity + 1) = std::tan(latitude) / east_m;
  f(kRotation, kPosition) = earth_.rate_radps * std::sin(latitude) / north_m;
  f(kRotation + 2, kPosition) =
      (earth_.rate_radps * std::cos(latitude) + state_.velocity_ned_mps.y() / (east_m * squared(std::cos(latitude)))) /
      north_m;
  f.block<3, 3>(kFixError, kFixError) = -Matrix3d::Identity() / model_.fix_wander_s;
  f.block<3, 3>(kCarrier, kCarrier) = -Matrix3d::Identity() / model_.carrier_s;
  f(kLevel, kLevel) = -1.0 / model_.level_wander_s;
  f(kCompassWander, kCompassWander) = -1.0 / model_.compass_wander_s;
  return f;
}

void NavigationFilter::propagate_covariance() {
  if (pending_s_ <= 0.0) return;
  // Only position, velocity and rotation are led by other errors: those of sensors keep to themselves. The transition
  // to second order in time is therefore [moves; 0, keeps], keeps diagonal.
  constexpr int kMoving = kGyroBias, kSensors = kErrorCount - kMoving;
  const double t = pending_s_;
  const Covariance ft = t * error_rates(pending_velocity_ned_ / t, pending_turn_rad_ / t);
  const Eigen::Matrix<double, kSensors, 1> decays = ft.diagonal().tail<kSensors>();
  Eigen::Matrix<double, kMoving, kErrorCount> moves =
      0.5 * ft.topLeftCorner<kMoving, kMoving>() * ft.topRows<kMoving>();
  moves.rightCols<kSensors>() += 0.5 * ft.topRightCorner<kMoving, kSensors>() * decays.asDiagonal();
  moves += ft.topRows<kMoving>();
  moves.leftCols<kMoving>().diagonal().array() += 1.0;
  const Eigen::Matrix<double, kSensors, 1> keeps = 1.0 + decays.array() + 0.5 * decays.array().square();

  Eigen::Matrix<double, kErrorCount, 1> noise = Eigen::Matrix<double, kErrorCount, 1>::Zero();
  noise.segment<3>(kVelocity).setConstant(squared(model_.imu.accelerometer.random_walk));
  noise.segment<3>(kRotation).setConstant(squared(model_.imu.gyro.random_walk));
  noise.segment<3>(kGyroBias).setConstant(bias_drive(model_.imu.gyro));
  noise.segment<3>(kForceBias).setConstant(bias_drive(model_.imu.accelerometer));
  const double drive = 2.0 / model_.fix_wander_s;
  noise.segment<3>(kFixError) << drive * squared(model_.fix_wander_horizontal_m),
      drive * squared(model_.fix_wander_horizontal_m), drive * squared(model_.fix_wander_vertical_m);
  noise.segment<2>(kCurrent).setConstant(squared(model_.current_walk_mps_per_sqrt_s) +
                                         squared(model_.current_walk_mps_per_sqrt_m) *
                                             std::abs(state_.velocity_ned_mps.z()));
  noise.segment<3>(kCarrier).setConstant(2.0 / model_.carrier_s);
  noise[kLevel] = 2.0 / model_.level_wander_s * squared(model_.level_wander_m);
  noise[kCompassWander] = 2.0 / model_.compass_wander_s * squared(model_.compass_wander_rad);

  // Noise of the step by the trapezoidal rule: half of it enters before the transition, half after.
  covariance_.diagonal() += 0.5 * t * noise;
  const Eigen::Matrix<double, kMoving, kErrorCount> moved = moves * covariance_;
  const Eigen::Matrix<double, kMoving, kMoving> motion = moved * moves.transpose();
  covariance_.topLeftCorner<kMoving, kMoving>() = 0.5 * (motion + motion.transpose());
  covariance_.topRightCorner<kMoving, kSensors>() = moved.rightCols<kSensors>() * keeps.asDiagonal();
  covariance_.bottomLeftCorner<kSensors, kMoving>() = covariance_.topRightCorner<kMoving, kSensors>().transpose();
  covariance_.bottomRightCorner<kSensors, kSensors>().array() *= (keeps * keeps.transpose()).array();
  covariance_.diagonal() += 0.5 * t * noise;
  pending_s_ = 0.0;
  pending_velocity_ned_.setZero();
  pending_turn_rad_.setZero();
}

template <int N>
Innovation NavigationFilter::correct(const Eigen::Matrix<double, N, 1>& residual, const Observation<N>& observation,
                                     const Eigen::Matrix<double, N, 1>& sigma) {
  using Square = Eigen::Matrix<double, N, N>;
  const Square noise = sigma.cwiseAbs2().asDiagonal();
  const Eigen::Matrix<double, kErrorCount, N> cross_covariance = covariance_ * observation.transpose();
  const Square expected_covariance = observation * cross_covariance + noise;
  const Eigen::LDLT<Square> expected(expected_covariance);
  Innovation innovation{residual.dot(expected.solve(residual))};
  innovation.accepted = innovation.normalised_squared <= gate * gate + N;
  if (!innovation.accepted) return innovation;

  const Eigen::Matrix<double, kErrorCount, N> gain = expected.solve(cross_covariance.transpose()).transpose();
  // Joseph's form (I - K H) P (I - K H)' + K R K', multiplied out: symmetric, and as safe where the gain is not exact.
  const Eigen::Matrix<double, kErrorCount, N> half = 0.5 * gain * expected_covariance - cross_covariance;
  const Covariance change = half * gain.transpose();
  covariance_ += change + change.transpose();
  add(gain * residual);
  return innovation;
}

void NavigationFilter::add(const Eigen::Matrix<double, kErrorCount, 1>& errors) {
  const double latitude = state_.latitude_rad;
  const double north_m = meridian_radius_m(earth_, latitude) + state_.height_m;
  const double east_m = (prime_vertical_radius_m(earth_, latitude) + state_.height_m) * std::cos(latitude);
  const Vec3 place = errors.segment<3>(kPosition), velocity = errors.segment<3>(kVelocity);
  const Vec3 rotation = errors.segment<3>(kRotation);
  const double angle = rotation.norm();
  const frames::Quaternion turn(angle > 0.0 ? Eigen::AngleAxisd(angle, rotation / angle)
                                            : Eigen::AngleAxisd(0.0, Vec3::UnitX()));
  const auto move = [&](NavigationState& state, double age_s) {
    const Vec3 by = place - age_s * velocity;
    state.latitude_rad += by.x() / north_m;
    state.longitude_rad += by.y() / east_m;
    state.height_m -= by.z();
    state.velocity_ned_mps += velocity;
    state.ned_from_body = (turn * state.ned_from_body).normalized();
  };
  move(state_, 0.0);
  for (Past& past : past_) move(past.state, t_s_ - past.t_s);
  gyro_bias_ += errors.segment<3>(kGyroBias);
  force_bias_ += errors.segment<3>(kForceBias);
  fix_error_ += errors.segment<3>(kFixError);
  current_ned_.head<2>() += errors.segment<2>(kCurrent);
  carrier_error_ += errors.segment<3>(kCarrier);
  level_error_m_ += errors[kLevel];
  compass_wander_rad_ += errors[kCompassWander];
  compass_deviation_rad_ += errors.segment<5>(kCompassDeviation);
  log_scale_ += errors[kLogScale];
  for (int row = 0; row < 3; ++row) {
    gyro_matrix_.row(row) += errors.segment<3>(kGyroMatrix + 3 * row).transpose();
    force_matrix_.row(row) += errors.segment<3>(kForceMatrix + 3 * row).transpose();
  }
}

Vec3 NavigationFilter::turn_rate_radps() const {
  return rate_radps_ + rate_growth_radps_ -
         state_.ned_from_body.conjugate() * inertial::earth_rate_ned_radps(state_, earth_);
}

NavigationFilter::PointCovariance NavigationFilter::covariance_at(const Vec3& lever_body_m) const {
  // The errors that count, of the velocity's observation v + C (rate x lever): rate's error is that of the gyros.
  constexpr int kMotion = kForceBias, kAll = kMotion + 9;
  const Matrix3d ned_from_body = state_.ned_from_body.toRotationMatrix();
  const Vec3 rate = turn_rate_radps();
  const Matrix3d swings = ned_from_body * cross(lever_body_m);  // what an error of the gyros does to the velocity
  Eigen::Matrix<double, 3, kAll> place = Eigen::Matrix<double, 3, kAll>::Zero(), velocity = place;
  place.middleCols<3>(kPosition).setIdentity();
  place.middleCols<3>(kRotation) = -cross(ned_from_body * lever_body_m);
  velocity.middleCols<3>(kVelocity).setIdentity();
  velocity.middleCols<3>(kRotation) = -cross(ned_from_body * rate.cross(lever_body_m));
  velocity.middleCols<3>(kGyroBias) = swings;
  for (int row = 0; row < 3; ++row) {
    velocity.middleCols<3>(kMotion + 3 * row) = swings.col(row) * rate.transpose();
  }
  Eigen::Matrix<double, kAll, kAll> of;
  of.topLeftCorner<kMotion, kMotion>() = covariance_.topLeftCorner<kMotion, kMotion>();
  of.topRightCorner<kMotion, 9>() = covariance_.block<kMotion, 9>(0, kGyroMatrix);
  of.bottomLeftCorner<9, kMotion>() = covariance_.block<9, kMotion>(kGyroMatrix, 0);
  of.bottomRightCorner<9, 9>() = covariance_.block<9, 9>(kGyroMatrix, kGyroMatrix);
  PointCovariance at{place * of * place.transpose(), velocity * of * velocity.transpose()};
  if (interval_s_ > 0.0) {  // white noise of a rate that is 3/2 of a reading less 1/2 of the one before
    at.velocity_m2ps2 += 2.5 * squared(model_.imu.gyro.random_walk) / interval_s_ * swings * swings.transpose();
  }
  return at;
}

Innovation NavigationFilter::correct_position(const Fix& fix, double age_s) {
  propagate_covariance();
  const std::optional<NavigationState> then = recall(age_s);
  if (!then) return {0.0, false};
  const double latitude = then->latitude_rad;
  const double north_m = meridian_radius_m(earth_, latitude) + then->height_m;
  const double east_m = (prime_vertical_radius_m(earth_, latitude) + then->height_m) * std::cos(latitude);
  const Vec3 lever_ned = then->ned_from_body * fix.lever_body_m;
  const Vec3 apart((fix.latitude_rad - latitude) * north_m,
                   std::remainder(fix.longitude_rad - then->longitude_rad, 2.0 * std::numbers::pi) * east_m,
                   then->height_m - fix.height_m);

  Observation<3> h = Observation<3>::Zero();
  h.block<3, 3>(0, kPosition).setIdentity();
  h.block<3, 3>(0, kVelocity).diagonal().setConstant(-std::max(0.0, age_s));
  h.block<3, 3>(0, kRotation) = -cross(lever_ned);
  h.block<3, 3>(0, kCarrier) = fix.carrier_sigma_ned_m.asDiagonal();
  const Vec3 off = apart - lever_ned - fix.carrier_sigma_ned_m.cwiseProduct(carrier_error_);
  if (!fix.wanders) return correct<3>(off, h, fix.sigma_ned_m);
  h.block<3, 3>(0, kFixError).setIdentity();
  return correct<3>(off - fix_error_, h, fix.sigma_ned_m);
}

Innovation NavigationFilter::correct_velocity(const Vec3& velocity_body_mps, const Vec3& lever_body_m,
                                              const Vec3& sigma_body_mps) {
  return correct_log(Tracked::kBottom, velocity_body_mps, lever_body_m, sigma_body_mps);
}

Innovation NavigationFilter::correct_water_velocity(const Vec3& velocity_body_mps, const Vec3& lever_body_m,
                                                    const Vec3& sigma_body_mps) {
  return correct_log(Tracked::kWater, velocity_body_mps, lever_body_m, sigma_body_mps);
}

Innovation NavigationFilter::correct_log(Tracked tracked, const Vec3& velocity_body_mps, const Vec3& lever_body_m,
                                         const Vec3& sigma_body_mps) {
  propagate_covariance();
  const Matrix3d body_from_ned = state_.ned_from_body.conjugate().toRotationMatrix();
  const bool water = tracked == Tracked::kWater;
  const Vec3 passing_ned = state_.velocity_ned_mps - (water ? current_ned_ : Vec3(Vec3::Zero()));
  const Vec3 own = body_from_ned * passing_ned + turn_rate_radps().cross(lever_body_m);
  const double scale = 1.0 + log_scale_;
  Observation<3> h = Observation<3>::Zero();
  h.block<3, 3>(0, kVelocity) = scale * body_from_ned;
  h.block<3, 3>(0, kRotation) = scale * body_from_ned * cross(passing_ned);
  h.col(kLogScale) = own;
  if (water) h.block<3, 2>(0, kCurrent) = -scale * body_from_ned.leftCols<2>();
  return correct<3>(velocity_body_mps - scale * own, h, sigma_body_mps);
}

Innovation NavigationFilter::correct_height(double height_m, const Vec3& lever_body_m, double sigma_m) {
  propagate_covariance();
  const Vec3 lever_ned = state_.ned_from_body * lever_body_m;
  Observation<1> h = Observation<1>::Zero();
  h(0, kPosition + 2) = 1.0;
  h.block<1, 3>(0, kRotation) = -cross(lever_ned).row(2);
  h(0, kLevel) = -1.0;  // up, where the position error is down
  return correct<1>(Eigen::Matrix<double, 1, 1>(state_.height_m + level_error_m_ - height_m - lever_ned.z()), h,
                    Eigen::Matrix<double, 1, 1>(sigma_m));
}

double NavigationFilter::compass_error_rad(double heading_rad) const {
  return compass_wander_rad_ + compass_deviation_rad_.dot(deviation_shape(heading_rad));
}

Innovation NavigationFilter::correct_heading(double heading_rad, const Vec3& axis_body, double sigma_rad) {
  propagate_covariance();
  const Vec3 axis = state_.ned_from_body * axis_body;
  const double level2 = squared(axis.x()) + squared(axis.y());
  if (level2 < 0.01) return {0.0, false};  // within 6 degrees of up or down
  const double own_rad = std::atan2(axis.y(), axis.x());
  Observation<1> h = Observation<1>::Zero();
  h.block<1, 3>(0, kRotation) << -axis.z() * axis.x() / level2, -axis.z() * axis.y() / level2, 1.0;
  h(0, kCompassWander) = 1.0;
  h.block<1, 5>(0, kCompassDeviation) = deviation_shape(own_rad).transpose();
  const double off_rad = frames::wrap_pi(heading_rad - own_rad - compass_error_rad(own_rad));
  return correct<1>(Eigen::Matrix<double, 1, 1>(off_rad), h, Eigen::Matrix<double, 1, 1>(sigma_rad));
}

}  // namespace ensonify::navigation_filter
