#include "components/navigation/estimator.h"

#include <cmath>
#include <numbers>

#include "components/navigation/world_frame.h"

namespace ensonify {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
const inertial::Earth kEarth;

std::array<double, 3> plain(const frames::Vec3& v) { return {v.x(), v.y(), v.z()}; }

std::array<double, 9> rows_of(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

navigation_filter::FilterModel model_of(const Instruments& carried) {
  navigation_filter::FilterModel model;
  model.imu = carried.imu->errors();
  if (carried.gnss) {
    const sensors::GnssErrors& gnss = carried.gnss->errors;
    model.fix_wander_horizontal_m = gnss.hdop * gnss.fix.wander_horizontal_m;
    model.fix_wander_vertical_m = gnss.hdop * gnss.fix.wander_vertical_m;
    model.fix_wander_s = gnss.wander_s;
  }
  if (const auto& heading = carried.heading) {
    const sensors::ScalarErrors& errors = heading->angle;
    const auto& [a_rad, b_rad, c_rad, d_rad, e_rad] = heading->errors.deviation.abcde_rad;
    model.compass_wander_rad = errors.wander;
    model.compass_wander_s = errors.wander_s;
    model.compass_deviation_rad = {std::hypot(errors.bias_sigma, a_rad), b_rad, c_rad, d_rad, e_rad};
  }
  if (const auto& log = carried.velocity_log) {
    model.log_scale = log->errors.scale;
    model.current_mps = log->current_prior_mps;
    model.current_walk_mps_per_sqrt_s = log->current_walk_mps_per_sqrt_s;
    model.current_walk_mps_per_sqrt_m = log->current_walk_mps_per_sqrt_m;
  }
  if (const auto& depth = carried.depth) {
    const sensors::ScalarErrors& errors = depth->errors;
    constexpr double kForever_s = 1e6;  // a bias that is drawn once
    model.level_wander_m = std::hypot(errors.bias_sigma, errors.wander);
    model.level_wander_s = errors.bias_sigma > 0.0 ? kForever_s : errors.wander_s;
  }
  if (const auto& fixes = carried.usbl_fixes) {
    model.carrier_s = fixes->wander_s;
    model.remembered_s = 10.0;  // an array's slowest answer, and telemetry
  }
  return model;
}

}  // namespace

Estimator::Estimator(const Instruments& carried, std::uint64_t seed, const std::string& process)
    : config_(*carried.imu),
      model_(model_of(carried)),
      imu_(config_.errors(), {seed, process + "/gyro"}, {seed, process + "/accelerometer"}),
      alignment_(seed, process + "/alignment") {}

void Estimator::align(const inertial::NavigationState& truth) {
  const navigation_filter::StartErrors& e = config_.alignment;
  const auto drawn = [this](std::uint64_t i) { return alignment_.normal(i); };
  inertial::NavigationState state = truth;
  const double latitude = truth.latitude_rad;
  state.latitude_rad += e.position_m * drawn(0) / meridian_radius_m(kEarth, latitude);
  state.longitude_rad += e.position_m * drawn(1) / (prime_vertical_radius_m(kEarth, latitude) * std::cos(latitude));
  state.height_m += e.height_m * drawn(2);
  state.velocity_ned_mps += e.velocity_mps * frames::Vec3(drawn(3), drawn(4), drawn(5));
  const frames::Vec3 turn(e.tilt_rad * drawn(6), e.tilt_rad * drawn(7), e.heading_rad * drawn(8));
  if (turn.norm() > 0.0) {
    state.ned_from_body = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * truth.ned_from_body;
  }
  filter_.emplace(state, e, model_, kEarth);
}

std::optional<msg::InertialIncrements> Estimator::advance(const msg::Pose& pose, const frames::LocalProjection& world) {
  const inertial::NavigationState now = geodetic_state(moving_pose(pose), config_.instrument.actual, world);
  if (!truth_) {
    align(now);
    truth_ = now;
    stamp_ns_ = pose.stamp_ns;
    return std::nullopt;
  }
  if (pose.stamp_ns <= stamp_ns_) return std::nullopt;
  const double dt_s = seconds(SimTime{pose.stamp_ns - stamp_ns_});
  const inertial::Inertial read = imu_.measure(inertial::sensed_between(*truth_, now, dt_s, kEarth), dt_s);
  filter_->propagate(read, dt_s);
  truth_ = now;
  stamp_ns_ = pose.stamp_ns;

  std::vector<Waiting> due;
  due.swap(waiting_);
  for (Waiting& w : due) correct(w.stamped_s, std::move(w.correction));

  msg::InertialIncrements increments;
  increments.stamp_ns = stamp_ns_;
  increments.interval_s = dt_s;
  increments.angle_rad = plain(dt_s * read.rate_radps);
  increments.velocity_mps = plain(dt_s * read.force_mps2);
  return increments;
}

void Estimator::correct(double stamped_s, std::function<void(Filter&)> correction) {
  constexpr double kSame_s = 1e-6;
  if (!filter_) return;
  if (stamped_s <= seconds(SimTime{stamp_ns_}) + kSame_s) {
    correction(*filter_);
  } else {
    waiting_.push_back({stamped_s, std::move(correction)});
  }
}

frames::Vec3 Estimator::along_unit(const frames::Vec3& vector_body) const {
  return config_.instrument.measured.body_from_head.conjugate() * vector_body;
}

frames::Vec3 Estimator::lever_of(const frames::Vec3& point_body_m) const {
  return along_unit(point_body_m - config_.instrument.measured.position_body_m);
}

msg::Estimate Estimator::estimate(const frames::LocalProjection& world) const {
  const inertial::NavigationState& unit = filter_->state();
  const frames::Vec2 place = world.enu_of({unit.latitude_rad / kDegree, unit.longitude_rad / kDegree});
  const frames::Quaternion enu_from_ned = enu_from_true_ned(world, place);
  const frames::Mounting& mounting = config_.instrument.measured;
  const frames::Quaternion enu_from_unit = enu_from_ned * unit.ned_from_body;
  const frames::Vec3 origin_unit_m = lever_of(frames::Vec3::Zero());
  const frames::Vec3 swing = filter_->turn_rate_radps().cross(origin_unit_m);

  msg::Estimate estimate;
  estimate.stamp_ns = stamp_ns_;
  estimate.position_enu_m = plain(frames::Vec3(place.x(), place.y(), unit.height_m) + enu_from_unit * origin_unit_m);
  estimate.enu_from_body = frames::wxyz_of(enu_from_unit * mounting.body_from_head.conjugate());
  estimate.velocity_enu_mps = plain(enu_from_ned * unit.velocity_ned_mps + enu_from_unit * swing);
  const Eigen::Matrix3d turn = enu_from_ned.toRotationMatrix();
  const auto in_enu = [&](const Eigen::Matrix3d& ned) { return rows_of(turn * ned * turn.transpose()); };
  const auto origin = filter_->covariance_at(origin_unit_m);
  estimate.position_covariance_enu_m2 = in_enu(origin.position_m2);
  estimate.velocity_covariance_enu_m2ps2 = in_enu(origin.velocity_m2ps2);
  constexpr int kRotation = navigation_filter::kRotation;
  estimate.rotation_covariance_enu_rad2 = in_enu(filter_->covariance().block<3, 3>(kRotation, kRotation));
  return estimate;
}

}  // namespace ensonify
