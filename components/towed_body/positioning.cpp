#include "components/towed_body/positioning.h"

#include <algorithm>
#include <cmath>

namespace ensonify {
namespace {

constexpr double kApart_m = 1.0;
constexpr double kShapeError = 0.05;  // of the layback, as stated: what the cable's shape is not known by

frames::Vec3 vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

TowEstimator::TowEstimator(const TowedBodyConfig& config)
    : config_(config), noise_(config.seed, config.process + "/sensors") {}

void TowEstimator::take(const msg::Estimate& vessel) {
  vessel_ = vessel;
  const frames::Pose pose{vec(vessel.position_enu_m), frames::quaternion_of(vessel.enu_from_body)};
  const frames::Vec3 sheave = frames::enu_from_body(pose, vec(config_.sheave_m));
  if (sheave_enu_m_.size() > 1 && (sheave - sheave_enu_m_[sheave_enu_m_.size() - 2]).head<2>().norm() < kApart_m) {
    sheave_enu_m_.pop_back();  // the newest place moves on until it is far enough
  }
  sheave_enu_m_.push_back(sheave);
  const auto most = static_cast<std::size_t>(2.0 * config_.cable.out_m / kApart_m) + 10;
  while (sheave_enu_m_.size() > most) sheave_enu_m_.pop_front();
}

void TowEstimator::take(const msg::UsblFix& fix) {
  if (fix.valid) fix_ = fix;
}

double TowEstimator::vessel_speed_mps() const { return vec(vessel_->velocity_enu_mps).head<2>().norm(); }

/// Back on the sheave's track by the horizontal side of a straight cable; beyond its beginning straight on.
TowEstimator::Place TowEstimator::by_layback(double height_m) const {
  const double out_m = config_.cable.out_m * (1.0 + config_.positioning.cable_scale);
  const double below_m = std::clamp(sheave_enu_m_.back().z() - height_m, 0.0, out_m);
  const double layback_m = config_.positioning.layback_factor * std::sqrt(out_m * out_m - below_m * below_m);
  double left_m = layback_m;
  frames::Vec2 place = sheave_enu_m_.back().head<2>();
  const double heading_rad = frames::attitude_of(frames::quaternion_of(vessel_->enu_from_body)).heading_rad;
  frames::Vec2 back(-std::sin(heading_rad), -std::cos(heading_rad));
  for (std::size_t i = sheave_enu_m_.size() - 1; i > 0; --i) {
    const frames::Vec2 before = sheave_enu_m_[i - 1].head<2>();
    const double step_m = (before - place).norm();
    if (step_m > 1e-9) back = (before - place) / step_m;
    if (step_m >= left_m) break;
    left_m -= step_m;
    place = before;
  }
  const auto& variance = vessel_->position_covariance_enu_m2;
  return {place + left_m * back, std::hypot(kShapeError * layback_m, std::sqrt(std::max(variance[0], variance[4])))};
}

/// Goes on as fast as the vessel, the way the body heads, and is pulled to each fix.
std::optional<TowEstimator::Place> TowEstimator::by_usbl(SimTime now, double heading_rad) {
  const frames::Vec2 velocity = vessel_speed_mps() * frames::Vec2(std::sin(heading_rad), std::cos(heading_rad));
  if (followed_enu_m_) *followed_enu_m_ += seconds(now - followed_at_) * velocity;
  followed_at_ = now;
  if (fix_) {
    const frames::Vec2 since_m = seconds(now - SimTime{fix_->stamp_ns}) * velocity;
    const frames::Vec2 reported = vec(fix_->position_enu_m).head<2>() + since_m;
    followed_enu_m_ =
        followed_enu_m_ ? *followed_enu_m_ + config_.positioning.usbl_gain * (reported - *followed_enu_m_) : reported;
    fix_sigma_m_ = std::max(fix_->sigma_enu_m[0], fix_->sigma_enu_m[1]);
    fix_.reset();
  }
  if (!followed_enu_m_) return std::nullopt;
  return Place{*followed_enu_m_, fix_sigma_m_};
}

std::optional<msg::Estimate> TowEstimator::estimate(SimTime now, std::uint64_t n, const frames::Pose& body) {
  if (!vessel_) return std::nullopt;
  const TowPositioning& errors = config_.positioning;
  frames::Attitude attitude = frames::attitude_of(body.enu_from_body);
  attitude.heading_rad += errors.heading_white_rad * noise_.normal(n, 0);
  attitude.pitch_rad += errors.level_white_rad * noise_.normal(n, 1);
  attitude.roll_rad += errors.level_white_rad * noise_.normal(n, 2);
  const double height_m = body.position_enu_m.z() + errors.depth_white_m * noise_.normal(n, 3);
  const auto place =
      errors.by == TowPositioning::By::kUsbl ? by_usbl(now, attitude.heading_rad) : std::optional(by_layback(height_m));
  if (!place) return std::nullopt;

  msg::Estimate estimate;
  estimate.stamp_ns = now.count();
  estimate.position_enu_m = {place->enu_m.x(), place->enu_m.y(), height_m};
  estimate.enu_from_body = frames::wxyz_of(frames::enu_from_body(attitude));
  const double speed_mps = vessel_speed_mps();
  estimate.velocity_enu_mps = {speed_mps * std::sin(attitude.heading_rad), speed_mps * std::cos(attitude.heading_rad),
                               0.0};
  const double variance_m2 = place->sigma_m * place->sigma_m;
  estimate.position_covariance_enu_m2 = {
      variance_m2, 0, 0, 0, variance_m2, 0, 0, 0, errors.depth_white_m * errors.depth_white_m};
  const double level_rad2 = errors.level_white_rad * errors.level_white_rad;
  estimate.rotation_covariance_enu_rad2 = {
      level_rad2, 0, 0, 0, level_rad2, 0, 0, 0, errors.heading_white_rad * errors.heading_white_rad};
  return estimate;
}

}  // namespace ensonify
