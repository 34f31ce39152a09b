#include "components/navigation/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "components/navigation/world_frame.h"

namespace ensonify {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

template <class V>
std::array<double, 3> plain(const V& v) {
  return {v.x(), v.y(), v.z()};
}

constexpr SimTime kKept = 10_s;  // of the target's poses: an answer from 10 km is 7 s old

}  // namespace

Suite::Suite(const NavigationConfig& config, Ports& ports, const To& to)
    : heights_(config.heights),
      positions_(to.positions),
      water_(config.instruments, config.water, config.heights, seabed_, config.seed, config.process, ports,
             to.sound_speeds) {
  const Instruments& carried = config.instruments;
  const auto stream = [&](const char* name) { return random::Stream(config.seed, config.process + "/" + name); };
  const auto rate = [](const Instrument& instrument) { return OutOptions{.rate = rate_of(instrument.rate_hz)}; };
  if (const auto& c = carried.gnss) {
    gnss_.emplace(*c, sensors::Gnss(c->errors, stream("gnss")));
  }
  if (const auto& c = carried.heading) {
    heading_.emplace(*c, sensors::HeadingSensor(c->errors, c->angle, stream("heading")));
    headings_out_ = ports.out<msg::Heading>("heading", rate(c->instrument));
  }
  if (const auto& c = carried.velocity_log) {
    log_.emplace(*c, sensors::DopplerLog(c->geometry, c->errors, stream("velocity_log")));
    velocities_out_ = ports.out<msg::VelocityLog>("velocity_log", rate(c->instrument));
  }
  if (const auto& c = carried.depth) {
    depth_.emplace(*c, sensors::ScalarSensor(c->errors, stream("depth")));
    depths_out_ = ports.out<msg::Depth>("depth", rate(c->instrument));
  }
  if (const auto& c = carried.altimeter) {
    altimeter_.emplace(*c, sensors::RangeSensor(c->errors, c->distance, stream("altimeter")));
    altitudes_out_ = ports.out<msg::Altitude>("altitude", rate(c->instrument));
  }
  if (carried.use_seabed()) seabed_.connect(ports, !carried.need_seabed());
}

SimTime Suite::next() const {
  SimTime next = std::min(outbox_.next(), water_.next());
  if (gnss_) next = std::min(next, gnss_->due.next());
  if (heading_) next = std::min(next, heading_->due.next());
  if (log_) next = std::min(next, log_->due.next());
  if (depth_) next = std::min(next, depth_->due.next());
  if (altimeter_) next = std::min(next, altimeter_->due.next());
  return next;
}

void Suite::step(SimTime now, const std::optional<msg::Pose>& truth,
                 const std::optional<frames::LocalProjection>& world, const EstimatedPose& estimated,
                 std::optional<Estimator>& estimator) {
  const auto n = static_cast<std::uint64_t>(log_ ? log_->due.count() : 0);
  const bool heading = heading_ && heading_->due.due(now), fix = gnss_ && gnss_->due.due(now);
  const bool velocity = log_ && log_->due.due(now), depth = depth_ && depth_->due.due(now);
  const bool altitude = altimeter_ && altimeter_->due.due(now);
  if (!truth || !world) return water_.step(now, nullptr, outbox_);
  const Moment moment{now,       seconds(SimTime{truth->stamp_ns}), moving_pose(*truth), *world,
                      estimated, estimator ? &*estimator : nullptr};
  if (heading) measure_heading(moment);
  if (fix) measure_fix(moment);
  if (velocity) measure_velocity(moment, n);
  if (depth) measure_depth(moment);
  if (altitude) measure_altitude(moment);
  water_.step(now, &moment, outbox_);
}

void Suite::measure_fix(const Moment& moment) {
  const Instrument& instrument = gnss_->config.instrument;
  const frames::Vec3 antenna_enu_m = frames::enu_from_body(moment.truth.pose, instrument.actual.position_body_m);
  const double above_water_m = antenna_enu_m.z() - heights_.water_level_m(moment.t_s);
  const sensors::GnssReading reading =
      gnss_->sensor.measure(above_water_m, instrument.out_at(moment.t_s), gnss_->since(moment.t_s));
  if (reading.quality == sensors::FixQuality::kNone) return;

  const frames::Vec3 measured_enu_m = antenna_enu_m + reading.error_enu_m;
  const double stamp_s = moment.stamp_s(instrument);
  const frames::Vec3& lever = instrument.measured.position_body_m;
  if (moment.estimator != nullptr) {
    const frames::Geodetic place = moment.world.geodetic_of(measured_enu_m.head<2>());
    const sensors::FixErrors& white =
        reading.quality == gnss_->config.errors.best ? gnss_->config.errors.fix : gnss_->config.errors.degraded;
    Estimator::Filter::Fix fix;
    fix.latitude_rad = place.latitude_deg * kDegree;
    fix.longitude_rad = place.longitude_deg * kDegree;
    fix.height_m = measured_enu_m.z();
    fix.lever_body_m = moment.estimator->lever_of(lever);
    const double floor_m = 1e-3;  // what no receiver resolves
    fix.sigma_ned_m =
        reading.hdop * frames::Vec3(std::max(white.horizontal_m, floor_m), std::max(white.horizontal_m, floor_m),
                                    std::max(white.vertical_m, floor_m));
    moment.estimator->correct(stamp_s, [fix](Estimator::Filter& filter) { filter.correct_position(fix); });
  }

  const frames::Vec3 origin_enu_m = measured_enu_m - moment.estimated.enu_from_body * lever;
  msg::Position position;
  position.stamp_ns = from_seconds(stamp_s).count();
  position.position_enu_m = plain(origin_enu_m);
  report_position(position, moment.world, heights_.datums);
  position.sigma_horizontal_m = reading.sigma_enu_m.x();
  position.sigma_vertical_m = reading.sigma_enu_m.z();
  position.quality = static_cast<std::int64_t>(reading.quality);
  position.hdop = reading.hdop;
  outbox_.at(moment.now + from_seconds(instrument.latency_s), [this, position] { positions_(position); });
}

void Suite::measure_heading(const Moment& moment) {
  const Instrument& instrument = heading_->config.instrument;
  const double dt_s = heading_->since(moment.t_s);
  const inertial::NavigationState compass = moment.at(instrument.actual);
  const frames::Quaternion estimated = compass.ned_from_body * instrument.measured.body_from_head.conjugate();
  const frames::Vec3 forward = estimated * frames::Vec3::UnitX();
  const double true_rad = std::atan2(forward.y(), forward.x());
  const double reading = heading_->sensor.measure(true_rad, compass.velocity_ned_mps.x(), compass.latitude_rad, dt_s);
  if (instrument.out_at(moment.t_s)) return;
  headings_.emplace_back(moment.now + from_seconds(instrument.latency_s), reading);
  msg::Heading heading;
  heading.heading_true_rad = reading;
  outbox_.publish(*headings_out_, heading, instrument, moment);
  if (moment.estimator != nullptr) {
    const sensors::ScalarErrors& e = heading_->config.angle;
    const double rounding_rad = e.resolution / std::sqrt(12.0);
    const double sigma_rad =
        std::max(1e-4, std::hypot(e.white, rounding_rad));  // the filter's model has the slow errors
    const frames::Vec3 forward_unit = moment.estimator->along_unit(frames::Vec3::UnitX());
    const double lag_s = e.lag_s;
    moment.estimator->correct(moment.stamp_s(instrument), [=](Estimator::Filter& filter) {
      const double turn_radps = (filter.state().ned_from_body * filter.turn_rate_radps()).z();
      filter.correct_heading(reading + lag_s * turn_radps, forward_unit, sigma_rad);
    });
  }
}

std::optional<double> Suite::heading_rad(SimTime now) {
  while (headings_.size() > 1 && headings_[1].first <= now) headings_.pop_front();
  if (headings_.empty() || headings_.front().first > now) return std::nullopt;
  return headings_.front().second;
}

void Suite::measure_velocity(const Moment& moment, std::uint64_t n) {
  const Instrument& instrument = log_->config.instrument;
  if (instrument.out_at(moment.t_s)) return;
  const frames::HeadPose head = frames::head_pose(moment.truth.pose, instrument.actual);
  std::array<std::optional<double>, 4> ranges;
  for (std::size_t beam = 0; beam < 4; ++beam) {
    ranges[beam] = seabed_.distance_m(head, log_->sensor.directions()[beam], log_->config.errors.longest_m);
  }
  const inertial::NavigationState transducer = moment.at(instrument.actual);
  const auto reading =
      log_->sensor.bottom_track(transducer.ned_from_body.conjugate() * transducer.velocity_ned_mps, ranges, n);

  const Eigen::Matrix3d body_from_log = instrument.measured.body_from_head.toRotationMatrix();
  const frames::Vec3 velocity = body_from_log * reading.velocity_mps;
  const frames::Vec3 sigma = (body_from_log.cwiseAbs2() * reading.sigma_mps.cwiseAbs2()).cwiseSqrt();
  msg::VelocityLog message;
  message.bottom_lock = reading.valid;
  message.velocity_body_mps = plain(velocity);
  message.sigma_body_mps = plain(sigma);
  for (std::size_t beam = 0; beam < 4; ++beam) message.range_m[beam] = reading.range_m[beam].value_or(0.0);
  message.altitude_m = reading.altitude_m.value_or(0.0);
  message.error_velocity_mps = reading.error_velocity_mps;
  track_water(moment, head, n, message);
  outbox_.publish(*velocities_out_, message, instrument, moment);
  report_velocity(moment, reading, &Estimator::Filter::correct_velocity);
}

void Suite::report_velocity(const Moment& moment, const sensors::DopplerReading& reading,
                            CorrectVelocity correct) const {
  if (moment.estimator == nullptr || !reading.valid) return;
  const Estimator& e = *moment.estimator;
  const Instrument& instrument = log_->config.instrument;
  const Eigen::Matrix3d body_from_log = instrument.measured.body_from_head.toRotationMatrix();
  const frames::Vec3 velocity = e.along_unit(body_from_log * reading.velocity_mps);
  const frames::Vec3 lever = e.lever_of(instrument.measured.position_body_m);
  const frames::Vec3 sigma = (body_from_log.cwiseAbs2() * reading.sigma_mps.cwiseAbs2()).cwiseSqrt().cwiseMax(1e-3);
  moment.estimator->correct(moment.stamp_s(instrument),
                            [=](Estimator::Filter& filter) { (filter.*correct)(velocity, lever, sigma); });
}

void Suite::track_water(const Moment& moment, const frames::HeadPose& head, std::uint64_t n,
                        msg::VelocityLog& message) const {
  const double below_m = log_->config.water_track_m;
  if (below_m <= 0.0) return;
  const frames::Mounting &actual = log_->config.instrument.actual, &measured = log_->config.instrument.measured;
  const double layer_m = frames::enu_from_head(head, {0.0, 0.0, below_m}).z();
  const frames::Vec3 through_enu_mps =
      moment.velocity_enu_mps(actual.position_body_m) - heights_.water_velocity_enu_mps(layer_m, moment.t_s);
  const auto reading = log_->sensor.water_track(head.enu_from_head.conjugate() * through_enu_mps, n);
  message.water_lock = reading.valid;
  message.water_velocity_body_mps = plain(frames::Vec3(measured.body_from_head * reading.velocity_mps));
  report_velocity(moment, reading, &Estimator::Filter::correct_water_velocity);
}

void Suite::measure_depth(const Moment& moment) {
  const Instrument& instrument = depth_->config.instrument;
  const double water_level_m = heights_.water_level_m(moment.t_s);
  const double true_m = vertical::depth_below_water_m(
      frames::enu_from_body(moment.truth.pose, instrument.actual.position_body_m), water_level_m);
  const double reading = depth_->sensor.measure(true_m, depth_->since(moment.t_s));
  if (instrument.out_at(moment.t_s)) return;
  msg::Depth depth;
  depth.depth_m = reading;
  outbox_.publish(*depths_out_, depth, instrument, moment);
  if (moment.estimator != nullptr) {
    const sensors::ScalarErrors& e = depth_->config.errors;
    const double sigma_m = std::max(1e-3, e.white);  // the filter's model has the slow errors
    const frames::Vec3 lever = moment.estimator->lever_of(instrument.measured.position_body_m);
    const double height_m = water_level_m - reading;  // the system knows the tide
    moment.estimator->correct(moment.stamp_s(instrument),
                              [=](Estimator::Filter& filter) { filter.correct_height(height_m, lever, sigma_m); });
  }
}

void Suite::measure_altitude(const Moment& moment) {
  const Instrument& instrument = altimeter_->config.instrument;
  const double dt_s = altimeter_->since(moment.t_s);
  if (instrument.out_at(moment.t_s)) return;
  const frames::HeadPose head = frames::head_pose(moment.truth.pose, instrument.actual);
  const auto reading = altimeter_->sensor.measure(
      seabed_.distance_m(head, frames::Vec3::UnitZ(), altimeter_->config.errors.longest_m), dt_s);
  msg::Altitude altitude;
  altitude.valid = reading.has_value();
  altitude.range_m = reading.value_or(0.0);
  outbox_.publish(*altitudes_out_, altitude, instrument, moment);
}

UsblTracker::UsblTracker(const UsblConfig& config, std::uint64_t seed, const std::string& process, Ports& ports)
    : array_(config, random::Stream(seed, process + "/usbl")),
      target_(kKept.count()),
      fixes_out_(ports.out<msg::UsblFix>("usbl", {.rate = rate_of(config.instrument.rate_hz)})) {
  ports.in<msg::Pose>("target", [this](const msg::Pose& pose) { target_.push(pose.stamp_ns, moving_pose(pose).pose); });
}

void UsblTracker::step(SimTime now, const Moment* moment, Outbox& outbox) {
  const auto n = static_cast<std::uint64_t>(array_.due.count());
  if (!array_.due.due(now) || moment == nullptr) return;
  const UsblConfig& config = array_.config;
  const Instrument& instrument = config.instrument;
  const frames::HeadPose head = frames::head_pose(moment->truth.pose, instrument.actual);
  const auto transponder_enu_m = answered_enu_m(*moment, head.position_enu_m);
  silence_ = target_.empty() ? "usbl: no pose of the target has come" : "";
  if (!transponder_enu_m || !moment->estimated.position_enu_m || instrument.out_at(moment->t_s)) return;

  msg::UsblFix fix;
  const frames::Vec3 place_array_m = frames::head_from_enu(head, *transponder_enu_m);
  const auto reading = sensors::locate(config.errors, place_array_m, array_.sensor, n);
  if (!reading) silence_ = why_silent(place_array_m);
  double age_s = 0.0;
  if (reading) {
    const frames::Mounting& measured = instrument.measured;
    const frames::Vec3 place_body_m = measured.body_from_head * reading->place_array_m;
    const frames::Quaternion& enu_from_body = moment->estimated.enu_from_body;
    const frames::Vec3 position_enu_m =
        *moment->estimated.position_enu_m + enu_from_body * (measured.position_body_m + place_body_m);
    const Eigen::Matrix3d enu_from_array = (enu_from_body * measured.body_from_head).toRotationMatrix();
    const frames::Vec3 sigma_enu_m = (enu_from_array.cwiseAbs2() * reading->sigma_array_m.cwiseAbs2()).cwiseSqrt();
    const auto plain = [](const frames::Vec3& v) { return std::array{v.x(), v.y(), v.z()}; };
    fix.valid = true;
    fix.range_m = reading->place_array_m.norm();
    fix.place_body_m = plain(place_body_m);
    fix.position_enu_m = plain(position_enu_m);
    fix.sigma_enu_m = plain(sigma_enu_m);
    age_s = reading->age_s;
  }
  fix.stamp_ns = from_seconds(moment->stamp_s(instrument) - age_s).count();
  outbox.at(moment->now + from_seconds(instrument.latency_s), [this, fix] { fixes_out_.send(fix); });
}

std::optional<frames::Vec3> UsblTracker::answered_enu_m(const Moment& moment, const frames::Vec3& array_enu_m) const {
  // Later than the newest pose, the newest serves; what answered before the first is not known.
  const auto place_at = [&](double t_s) -> std::optional<frames::Vec3> {
    const std::int64_t t_ns = from_seconds(t_s).count();
    if (target_.empty() || t_ns < target_.oldest_ns()) return std::nullopt;
    const auto pose = target_.at(t_ns, frames::PoseHistory::Outside::kNearest);
    return frames::enu_from_body(*pose, array_.config.transponder_body_m);
  };
  std::optional<frames::Vec3> place = place_at(moment.t_s);
  for (int round = 0; place && round < 2; ++round) {  // each leaves speed / sound speed of what was wrong
    const double way_s = (*place - array_enu_m).norm() / array_.config.errors.speed_of_sound_mps;
    place = place_at(moment.t_s - way_s);
  }
  return place;
}

std::string UsblTracker::why_silent(const frames::Vec3& place_array_m) const {
  const sensors::UsblErrors& errors = array_.config.errors;
  if (place_array_m.norm() > errors.longest_m) {
    return fmt::format("usbl: the transponder is {:.0f} m away, received within {:.0f}", place_array_m.norm(),
                       errors.longest_m);
  }
  return fmt::format(
      "usbl: the transponder is {:.0f} degrees off the array's axis, received within {:.0f}; turn the array",
      sensors::off_axis_rad(place_array_m) / kDegree, errors.widest_rad / kDegree);
}

}  // namespace ensonify
