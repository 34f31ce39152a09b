#include "components/navigation/node.h"

#include <algorithm>

#include "components/runtime/log.h"
#include "messages/terrain.h"

namespace ensonify {
namespace {

std::array<double, 3> plain(const frames::Vec3& v) { return {v.x(), v.y(), v.z()}; }

Rate attitude_rate(const NavigationConfig& config) {
  const auto& sensor = config.instruments.motion_sensor;
  return sensor ? rate_of(sensor->instrument.rate_hz) : Rate{config.attitude_rate_hz, 1};
}

Rate position_rate(const NavigationConfig& config) {
  const auto& gnss = config.instruments.gnss;
  return gnss ? rate_of(gnss->instrument.rate_hz) : Rate{config.position_rate_hz, 1};
}

/// How high above the water the antenna is at rest, or at the surface, if that is too low for fixes.
std::optional<double> low_antenna_m(const NavigationConfig& config) {
  const auto& gnss = config.instruments.gnss;
  if (!gnss) return std::nullopt;
  const double rest_m = config.heights.floats ? config.heights.rest_m : 0.0;
  const double above_m = rest_m - gnss->instrument.actual.position_body_m.z();
  return above_m <= gnss->errors.washed_depth_m ? std::optional(above_m) : std::nullopt;
}

Rate sound_speed_rate(const NavigationConfig& config) {
  const auto& probe = config.instruments.sound_speed;
  return probe ? rate_of(probe->instrument.rate_hz) : Rate{config.probe.rate_hz, 1};
}

}  // namespace

NavigationNode::NavigationNode(const Config& config, Ports& ports)
    : ports_(ports),
      sensors_(config),
      filter_(config.position_gain),
      imu_due_(rate_of(config.instruments.imu ? config.instruments.imu->instrument.rate_hz : 1.0)),
      attitude_due_(attitude_rate(config)),
      position_due_(Rate{config.position_rate_hz, 1}),
      sound_speed_due_(Rate{config.probe.rate_hz, 1}),
      motion_latency_(from_seconds(config.motion_latency_s)),
      sound_speed_latency_(from_seconds(config.probe.latency_s)),
      // What makes its own estimate of old attitudes has their age in it.
      output_age_(from_seconds(config.position_latency_s), config.instruments.imu ? motion_latency_ : SimTime{0}),
      attitudes_(ports.out<msg::Attitude>("attitude", {.rate = attitude_rate(config)})),
      positions_(ports.out<msg::Position>("position", {.rate = position_rate(config)})),
      sound_speeds_(ports.out<msg::SoundSpeed>("sound_speed", {.rate = sound_speed_rate(config)})),
      estimates_(ports.out<msg::Estimate>("estimate", {.rate = attitude_rate(config)})),
      carried_(config.instruments),
      suite_(config, ports,
             {[this](const msg::Position& position) { take_fix(position); },
              [this](const msg::SoundSpeed& reading) { sound_speeds_.send(reading); }}),
      low_antenna_m_(low_antenna_m(config)),
      afloat_(config.heights.floats.has_value()) {
  if (config.origin) world_.emplace(*config.origin);
  if (carried_.usbl) usbl_.emplace(*carried_.usbl, config.seed, config.process, ports);
  if (carried_.usbl_fixes) usbl_fixes_.emplace(*carried_.usbl_fixes, ports);
  if (carried_.imu) {
    estimator_.emplace(carried_, config.seed, config.process);
    increments_ = ports.out<msg::InertialIncrements>("imu", {.rate = rate_of(carried_.imu->instrument.rate_hz)});
  }
  if (carried_.motion_sensor) {
    motion_sensor_.emplace(*carried_.motion_sensor, config.seed, config.process);
    if (carried_.motion_sensor->delayed_heave_s > 0.0) {
      delayed_heaves_ = ports.out<msg::DelayedHeave>("delayed_heave", {.rate = attitude_rate(config)});
    }
  }
  // Fewer poses make fewer readings of an inertial unit.
  const Rate least = carried_.imu ? rate_of(carried_.imu->instrument.rate_hz) : Rate{};
  ports.in<msg::Pose>("pose",
                      [this](const msg::Pose& pose) {
                        truth_ = pose;
                        recent_.push_back(pose);
                        const std::int64_t old_ns = pose.stamp_ns - motion_latency_.count();
                        while (recent_.size() > 1 && recent_[1].stamp_ns <= old_ns) recent_.pop_front();
                      },
                      {.least = least});
  if (!world_) {
    ports.in<msg::Chart>("chart", [this](const msg::Chart& chart) {
      world_.emplace(frames::Geodetic{chart.origin_latitude_deg, chart.origin_longitude_deg});
    });
  }
}

SimTime NavigationNode::step(SimTime now) {
  const std::int64_t sample = attitude_due_.count(), fix = position_due_.count();
  if (sample == 0 && low_antenna_m_) {
    log::event(ports_, "antenna_under_water", "at_rest_above_water_m={:.2f}", *low_antenna_m_);
  }
  const bool attitude = attitude_due_.due(now), position = position_due_.due(now);
  const bool inertial = estimator_ && imu_due_.due(now);
  if (truth_ && world_ && inertial) {
    if (const auto increments = estimator_->advance(*truth_, *world_)) {
      outbox_.publish(*increments_, *increments, carried_.imu->instrument, now);
    }
  }
  if (usbl_fixes_ && world_) usbl_fixes_->correct(*estimator_, *world_);
  suite_.step(now, truth_, world_, estimated_pose_, estimator_);
  if (truth_ && world_) {
    if (attitude && !estimator_) filter_.predict(SimTime{truth_->stamp_ns}, sensors_.velocity_enu_mps(moved(), sample));
    if (position && !carried_.gnss) measure_position(fix);
    if (attitude) measure_attitude(now, sample);
  }
  if (usbl_) find_transponder(now);
  report_trouble();
  const std::int64_t dip = sound_speed_due_.count();
  if (sound_speed_due_.due(now) && truth_ && !carried_.sound_speed) {
    sound_speeds_under_way_.emplace_back(now + sound_speed_latency_, sensors_.sound_speed(*truth_, dip));
  }
  report_sound_speed(now);
  outbox_.send_due(now);
  suite_.send_due(now);
  SimTime next =
      std::min({attitude_due_.next(), position_due_.next(), sound_speed_due_.next(), suite_.next(), outbox_.next()});
  if (estimator_) next = std::min(next, imu_due_.next());
  if (usbl_) next = std::min(next, usbl_->next());
  return sound_speeds_under_way_.empty() ? next : std::min(next, sound_speeds_under_way_.front().first);
}

/// What the motion sensor measures now: the pose of its latency ago, with the newest stamp.
msg::Pose NavigationNode::moved() const {
  msg::Pose pose = recent_.front();
  pose.stamp_ns = truth_->stamp_ns;
  return pose;
}

void NavigationNode::report_sound_speed(SimTime now) {
  while (!sound_speeds_under_way_.empty() && sound_speeds_under_way_.front().first <= now) {
    sound_speeds_.send(sound_speeds_under_way_.front().second);
    sound_speeds_under_way_.pop_front();
  }
}

void NavigationNode::measure_position(std::int64_t n) {
  const msg::Position position = sensors_.position(*truth_, n, *world_);
  filter_.predict(SimTime{position.stamp_ns}, filter_.velocity_enu_mps());
  take_fix(position);
}

void NavigationNode::take_fix(const msg::Position& position) {
  positions_.send(position);
  if (estimator_) return;  // it has had the antenna's place
  const auto& fix = position.position_enu_m;
  filter_.correct({fix[0], fix[1], fix[2]});
}

void NavigationNode::measure_attitude(SimTime now, std::int64_t n) {
  msg::Attitude attitude = sensors_.attitude(moved(), n);
  const frames::Vec2 place(truth_->position_enu_m[0], truth_->position_enu_m[1]);
  if (const auto heading = suite_.heading_rad(now)) {
    attitude.heading_grid_rad = frames::wrap_two_pi(*heading - world_->convergence_rad(place));
  }
  if (motion_sensor_) {
    const msg::Attitude sensed = motion_sensor_->measure(moved());
    attitude.roll_rad = sensed.roll_rad;
    attitude.pitch_rad = sensed.pitch_rad;
    attitude.heave_m = sensed.heave_m;
  }
  estimated_pose_.enu_from_body =
      frames::enu_from_body({attitude.heading_grid_rad, attitude.pitch_rad, attitude.roll_rad});
  estimate(attitude);
  if (!motion_sensor_) return attitudes_.send(attitude);

  const Instrument& instrument = carried_.motion_sensor->instrument;
  const auto delayed = motion_sensor_->delayed_heave();
  if (instrument.out_at(seconds(SimTime{attitude.stamp_ns}))) return;
  outbox_.publish(attitudes_, attitude, instrument, now);
  if (delayed) outbox_.publish(*delayed_heaves_, *delayed, instrument, now);
}

/// After attitude has been measured: a degree of it is two metres at a hundred.
void NavigationNode::find_transponder(SimTime now) {
  if (!truth_ || !world_) return usbl_->step(now, nullptr, outbox_);
  const double t_s = seconds(SimTime{truth_->stamp_ns});
  const Moment moment{now, t_s, moving_pose(*truth_), *world_, estimated_pose_, nullptr};
  usbl_->step(now, &moment, outbox_);
}

/// A vehicle that dives has no fix most of the time; one that floats should have.
void NavigationNode::report_trouble() {
  std::string trouble;
  if (afloat_ && low_antenna_m_) {
    trouble = fmt::format("gnss: the antenna is {:.2f} m above the water at rest: few fixes or none", *low_antenna_m_);
  }
  if (usbl_ && !usbl_->silence().empty()) trouble += (trouble.empty() ? "" : "; ") + usbl_->silence();
  ports_.health(trouble.empty() ? "ok" : "degraded", trouble);
}

void NavigationNode::update_pose(const msg::Estimate& estimate) {
  const auto& [east_m, north_m, up_m] = estimate.position_enu_m;
  estimated_pose_ = {frames::quaternion_of(estimate.enu_from_body), frames::Vec3(east_m, north_m, up_m)};
}

void NavigationNode::estimate(const msg::Attitude& attitude) {
  if (estimator_) {
    if (!estimator_->ready()) return;
    const msg::Estimate estimate = estimator_->estimate(*world_);
    update_pose(estimate);
    return estimates_.send(output_age_.aged(estimate));
  }
  if (!filter_.ready()) return;
  msg::Estimate estimate;
  estimate.stamp_ns = attitude.stamp_ns;
  estimate.position_enu_m = plain(filter_.position_enu_m());
  estimate.enu_from_body = frames::wxyz_of(
      frames::enu_from_body(frames::Attitude{attitude.heading_grid_rad, attitude.pitch_rad, attitude.roll_rad}));
  estimate.velocity_enu_mps = plain(filter_.velocity_enu_mps());
  update_pose(estimate);
  estimates_.send(output_age_.aged(estimate));
}

}  // namespace ensonify
