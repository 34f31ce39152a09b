#include "components/navigation/estimator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/navigation/world_frame.h"
#include "kernels/base/frames/pose.h"

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
    model.compass_wander_rad = errors.wander;
    model.compass_wander_s = errors.wander_s;
    for (std::size_t i = 0; i < model.compass_deviation_rad.size(); ++i) {
      model.compass_deviation_rad[i] =
          std::hypot(heading->errors.deviation.abcde_rad[i], heading->errors.deviation_sigma.abcde_rad[i]);
    }
    model.compass_deviation_rad[0] = std::hypot(model.compass_deviation_rad[0], errors.bias_sigma);
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

void DeadReckoning::predict(SimTime t, const frames::Vec3& velocity) {
  if (moving_) position_enu_m_ += 0.5 * seconds(t - t_) * (velocity_enu_mps_ + velocity);
  velocity_enu_mps_ = velocity;
  t_ = t;
  moving_ = true;
}

void DeadReckoning::correct(const frames::Vec3& fix) {
  fixes_ = std::min(fixes_ + 1, 1'000'000);
  position_enu_m_ += std::max(gain_, 1.0 / fixes_) * (fix - position_enu_m_);
}

msg::Estimate OutputAge::aged(const msg::Estimate& now) {
  if (position_ == SimTime{0} && motion_ == SimTime{0}) return now;
  past_.push_back(now);
  const std::int64_t oldest_ns = now.stamp_ns - std::max(position_, motion_).count();
  while (past_.size() > 1 && past_[1].stamp_ns <= oldest_ns) past_.pop_front();
  const msg::Estimate place = at(now.stamp_ns - position_.count()), motion = at(now.stamp_ns - motion_.count());
  msg::Estimate reported = now;
  reported.position_enu_m = {place.position_enu_m[0], place.position_enu_m[1], motion.position_enu_m[2]};
  reported.enu_from_body = motion.enu_from_body;
  reported.velocity_enu_mps = motion.velocity_enu_mps;
  return reported;
}

msg::Estimate OutputAge::at(std::int64_t t_ns) const {
  const auto after = std::ranges::lower_bound(past_, t_ns, {}, &msg::Estimate::stamp_ns);
  if (after == past_.begin()) return *after;
  const msg::Estimate &a = *(after - 1), &b = *after;
  const double fraction = static_cast<double>(t_ns - a.stamp_ns) / static_cast<double>(b.stamp_ns - a.stamp_ns);
  const auto pose = [](const msg::Estimate& e) {
    return frames::Pose{frames::Vec3(e.position_enu_m.data()), frames::quaternion_of(e.enu_from_body)};
  };
  const frames::Pose between = frames::interpolate(pose(a), pose(b), fraction);
  msg::Estimate estimate = b;
  estimate.enu_from_body = frames::wxyz_of(between.enu_from_body);
  for (std::size_t k = 0; k < 3; ++k) {
    estimate.position_enu_m[k] = between.position_enu_m[static_cast<Eigen::Index>(k)];
    estimate.velocity_enu_mps[k] = a.velocity_enu_mps[k] + fraction * (b.velocity_enu_mps[k] - a.velocity_enu_mps[k]);
  }
  return estimate;
}

UsblFixes::UsblFixes(const UsblFixesConfig& config, Ports& ports) : config_(config) {
  ports.in<msg::UsblFix>("usbl_fix", [this](const msg::UsblFix& found) {
    if (found.valid) come_.push_back(found);
  });
}

void UsblFixes::correct(Estimator& estimator, const frames::LocalProjection& world) {
  if (!estimator.ready()) return;
  for (const msg::UsblFix& found : come_) {
    const double stamped_s = seconds(SimTime{found.stamp_ns});
    const double age_s = std::max(0.0, estimator.time_s() - stamped_s);
    estimator.correct(stamped_s, [fix = fix_of(found, estimator, world), age_s](Estimator::Filter& filter) {
      filter.correct_position(fix, age_s);
    });
  }
  come_.clear();
}

/// A small turn a about each axis moves what is at p by a sqrt(p^2 - p_i^2) along axis i; level axes of the other
/// vehicle are at any heading here, so that both get the mean of their variances.
Estimator::Filter::Fix UsblFixes::fix_of(const msg::UsblFix& found, const Estimator& estimator,
                                         const frames::LocalProjection& world) const {
  const frames::Vec3 place_m(found.place_body_m[0], found.place_body_m[1], found.place_body_m[2]);
  const double level2_m2 = place_m.head<2>().squaredNorm(), range2_m2 = place_m.squaredNorm();
  const double level_m = std::sqrt(0.5 * level2_m2);
  const auto turned_m = [&](double angle_rad) {
    const double across_m = angle_rad * std::sqrt(range2_m2 - 0.5 * level2_m2);
    return frames::Vec3(across_m, across_m, angle_rad * std::sqrt(level2_m2));
  };
  const frames::Vec3 slow_turn_m = turned_m(config_.attitude_rad), white_turn_m = turned_m(config_.attitude_white_rad);
  const frames::Vec3 stretch_m = config_.sound_speed_share * frames::Vec3(level_m, level_m, place_m.z());
  const frames::Vec3 array_ned_m(found.sigma_enu_m[1], found.sigma_enu_m[0], found.sigma_enu_m[2]);

  const frames::Geodetic place = world.geodetic_of({found.position_enu_m[0], found.position_enu_m[1]});
  constexpr double kDegree = std::numbers::pi / 180.0;
  Estimator::Filter::Fix fix;
  fix.latitude_rad = place.latitude_deg * kDegree;
  fix.longitude_rad = place.longitude_deg * kDegree;
  fix.height_m = found.position_enu_m[2];
  fix.lever_body_m = estimator.lever_of(config_.transponder_body_m);
  fix.sigma_ned_m = (array_ned_m.cwiseAbs2() + white_turn_m.cwiseAbs2()).cwiseSqrt().cwiseMax(1e-3);
  fix.wanders = false;
  fix.carrier_sigma_ned_m =
      (slow_turn_m.cwiseAbs2() + stretch_m.cwiseAbs2()).array() + config_.place_m * config_.place_m;
  fix.carrier_sigma_ned_m = fix.carrier_sigma_ned_m.cwiseSqrt().eval();
  return fix;
}

}  // namespace ensonify
