#include "components/nav_out/instruments.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "components/formats/em_attitude/writer.h"
#include "components/formats/km_binary/writer.h"
#include "components/formats/nmea/writer.h"
#include "components/formats/tss1/writer.h"

namespace ensonify::nav_out {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::uint8_t kGoodAttitude = 0x90, kInvalidAttitude = 0x9A;
constexpr double kWorstTilt_rad = 1.0 * kDegree, kWorstHeading_rad = 3.0 * kDegree;  // standard deviations, assumed
constexpr std::uint32_t kNoPlace = 1U;                                               // of KM binary's status

frames::Vec3 vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

std::string text_of(const formats::Bytes& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

/// Standard deviations about the body's axes, where the covariance is given.
nmea::MotionAccuracy accuracy_of(const msg::Estimate& estimate) {
  const Eigen::Matrix3d enu = Eigen::Map<const Eigen::Matrix3d>(estimate.rotation_covariance_enu_rad2.data());
  if (enu.isZero(0.0)) return {};
  const Eigen::Matrix3d axes = frames::quaternion_of(estimate.enu_from_body).toRotationMatrix();
  const frames::Vec3 body = (axes.transpose() * enu * axes).diagonal().cwiseMax(0.0).cwiseSqrt();
  return {body.x(), body.y(), body.z()};
}

nmea::Fix fix_of(const msg::Position& position, double time_s) {
  nmea::Fix fix;
  fix.time_s = time_s;
  fix.quality =
      position.quality > 0 ? static_cast<int>(position.quality) : nmea::quality_of(position.sigma_horizontal_m);
  fix.latitude_deg = position.latitude_deg;
  fix.longitude_deg = position.longitude_deg;
  fix.hdop = position.hdop > 0.0 ? position.hdop : 1.0;
  fix.height_above_geoid_m = position.height_above_geoid_m;
  fix.geoid_above_ellipsoid_m = position.geoid_above_ellipsoid_m;
  return fix;
}

}  // namespace

Motion motion_of(const msg::Estimate& estimate) {
  return {estimate.stamp_ns, vector_of(estimate.position_enu_m), frames::quaternion_of(estimate.enu_from_body),
          vector_of(estimate.velocity_enu_mps)};
}

Motion motion_of(const msg::Pose& pose) {
  return {pose.stamp_ns, vector_of(pose.position_enu_m), frames::quaternion_of(pose.enu_from_body),
          vector_of(pose.velocity_enu_mps)};
}

nmea::DateAndTime Earth::date_and_time(std::int64_t stamp_ns) const {
  const std::chrono::sys_time<std::chrono::nanoseconds> time{std::chrono::nanoseconds(unix_ns(stamp_ns))};
  const auto midnight = std::chrono::floor<std::chrono::days>(time);
  return {std::chrono::duration<double>(time - midnight).count(), midnight};
}

double Earth::time_s(std::int64_t stamp_ns) const { return date_and_time(stamp_ns).time_s; }

nmea::Course Earth::course_of(const Motion& motion) const {
  const frames::Vec3& v = motion.velocity_enu_mps;
  const double grid_rad = std::atan2(v.x(), v.y());
  return {frames::wrap_two_pi(grid_rad + world->convergence_rad(motion.position_enu_m.head<2>())), v.head<2>().norm()};
}

double Earth::heading_of(const Motion& motion) const {
  return frames::wrap_two_pi(frames::attitude_of(motion.enu_from_body).heading_rad +
                             world->convergence_rad(motion.position_enu_m.head<2>()));
}

formats::ais::PositionReport report_of(const Motion& motion, const Turning& turning, const Earth& earth,
                                       std::uint32_t mmsi) {
  const frames::Geodetic place = earth.world->geodetic_of(motion.position_enu_m.head<2>());
  const nmea::Course course = earth.course_of(motion);
  formats::ais::PositionReport report;
  report.mmsi = mmsi;
  report.status = 0;
  report.turn_rate_radps = turning.rate_radps();
  report.speed_mps = course.speed_mps;
  report.accurate = true;
  report.latitude_deg = place.latitude_deg;
  report.longitude_deg = place.longitude_deg;
  report.course_rad = course.true_course_rad;
  report.heading_rad = earth.heading_of(motion);
  report.second = static_cast<int>(earth.unix_ns(motion.stamp_ns) / kSecond_ns % 60);
  return report;
}

void Instruments::take(const msg::Attitude& attitude) {
  attitude_ = attitude;
  if (compass_ || !ready()) return;
  const double convergence_rad = earth_.world->convergence_rad(motion_of(*estimate_).position_enu_m.head<2>());
  heading_rad_ = frames::wrap_two_pi(attitude.heading_grid_rad + convergence_rad);
  turning_.take(attitude.stamp_ns, *heading_rad_);
}

void Instruments::take(const msg::Heading& heading) {
  heading_rad_ = heading.heading_true_rad;
  turning_.take(heading.stamp_ns, heading.heading_true_rad);
}

void Instruments::take(const msg::Estimate& estimate) {
  estimate_before_ = estimate_;
  estimate_ = estimate;
  accelerating_.take(estimate.stamp_ns, vector_of(estimate.velocity_enu_mps));
}

/// What the motion sensor says, with the heading that it has been given.
formats::Motion Instruments::motion() const {
  const double convergence_rad = earth_.world->convergence_rad(motion_of(*estimate_).position_enu_m.head<2>());
  formats::Motion motion;
  motion.time_s = earth_.time_s(attitude_->stamp_ns);
  motion.true_heading_rad = frames::wrap_two_pi(attitude_->heading_grid_rad + convergence_rad);
  motion.roll_rad = attitude_->roll_rad;
  motion.pitch_rad = attitude_->pitch_rad;
  motion.heave_m = attitude_->heave_m;
  return motion;
}

nmea::MotionQuality Instruments::quality() const {
  if (!estimate_) return {};
  const nmea::MotionAccuracy accuracy = accuracy_of(*estimate_);
  const double tilt_rad = std::max(accuracy.roll_rad.value_or(0.0), accuracy.pitch_rad.value_or(0.0));
  return {.heave = true,
          .roll_and_pitch = tilt_rad <= kWorstTilt_rad,
          .heading = accuracy.heading_rad.value_or(0.0) <= kWorstHeading_rad};
}

formats::km_binary::Sample Instruments::km_sample() const {
  const auto angles_of = [](const msg::Estimate& e) {
    return frames::attitude_of(frames::quaternion_of(e.enu_from_body));
  };
  const auto degrees = [](double rad) { return static_cast<float>(rad / kDegree); };
  const Motion motion = motion_of(*estimate_);
  const frames::Attitude angles = angles_of(*estimate_);
  const std::int64_t unix_ns = earth_.unix_ns(motion.stamp_ns);
  const frames::Geodetic place = earth_.world->geodetic_of(motion.position_enu_m.head<2>());
  formats::km_binary::Sample sample;
  sample.time_s = static_cast<std::uint32_t>(unix_ns / kSecond_ns);
  sample.time_ns = static_cast<std::uint32_t>(unix_ns % kSecond_ns);
  sample.status = position_ ? 0 : kNoPlace;
  sample.latitude_deg = place.latitude_deg;
  sample.longitude_deg = place.longitude_deg;
  if (position_) {
    const double ellipsoid_m = position_->height_above_geoid_m + position_->geoid_above_ellipsoid_m;
    sample.ellipsoid_height_m =
        static_cast<float>(ellipsoid_m + motion.position_enu_m.z() - position_->position_enu_m[2]);
  }
  sample.roll_deg = degrees(angles.roll_rad);
  sample.pitch_deg = degrees(angles.pitch_rad);
  sample.heading_deg = degrees(earth_.heading_of(motion));
  sample.heave_m = static_cast<float>(-attitude_->heave_m);  // down in the frame
  const nmea::Course course = earth_.course_of(motion);
  sample.velocity_mps = {static_cast<float>(course.speed_mps * std::cos(*course.true_course_rad)),
                         static_cast<float>(course.speed_mps * std::sin(*course.true_course_rad)),
                         static_cast<float>(-motion.velocity_enu_mps.z())};
  if (estimate_before_ && estimate_before_->stamp_ns < motion.stamp_ns) {
    const frames::Attitude before = angles_of(*estimate_before_);
    const double over_s = 1e-9 * static_cast<double>(motion.stamp_ns - estimate_before_->stamp_ns);
    sample.rate_degps = {degrees((angles.roll_rad - before.roll_rad) / over_s),
                         degrees((angles.pitch_rad - before.pitch_rad) / over_s),
                         degrees(frames::wrap_pi(angles.heading_rad - before.heading_rad) / over_s)};
  }
  const double convergence_rad = earth_.world->convergence_rad(motion.position_enu_m.head<2>());
  const frames::Vec3 grid = accelerating_.acceleration_enu_mps2();
  const double cosine = std::cos(convergence_rad), sine = std::sin(convergence_rad);
  sample.acceleration_mps2 = {static_cast<float>(grid.y() * cosine - grid.x() * sine),
                              static_cast<float>(grid.y() * sine + grid.x() * cosine), static_cast<float>(-grid.z())};
  const nmea::MotionAccuracy accuracy = accuracy_of(*estimate_);
  sample.attitude_sd_deg = {degrees(accuracy.roll_rad.value_or(0.0)), degrees(accuracy.pitch_rad.value_or(0.0)),
                            degrees(accuracy.heading_rad.value_or(0.0))};
  return sample;
}

std::string Instruments::motion_sentence(Kind kind) const {
  const formats::Motion said = motion();
  switch (kind) {
    case Kind::kPsxn23: return nmea::psxn_23(said);
    case Kind::kTss1: {
      const frames::Vec3 acceleration = accelerating_.acceleration_enu_mps2();
      const char settled = quality().roll_and_pitch ? 'F' : 'f';
      return formats::tss1::write({said, acceleration.head<2>().norm(), acceleration.z(), settled});
    }
    case Kind::kEmAttitude:
      return text_of(formats::em_attitude::write({said, quality().roll_and_pitch ? kGoodAttitude : kInvalidAttitude}));
    default: return nmea::pashr(said, accuracy_of(*estimate_), position_ ? fix_of(*position_, 0.0).quality : 0);
  }
}

std::string Instruments::say(Kind kind, const Output& output) const {
  const auto talker = [&](const char* usual) { return output.talker.empty() ? std::string(usual) : output.talker; };
  switch (kind) {
    case Kind::kGga:
      return position_ ? nmea::gga(talker("GP"), fix_of(*position_, earth_.time_s(position_->stamp_ns))) : "";
    case Kind::kGst: {
      if (!position_) return "";
      const double sigma_m = position_->sigma_horizontal_m;
      return nmea::gst(talker("GP"),
                       {earth_.time_s(position_->stamp_ns), sigma_m, sigma_m, position_->sigma_vertical_m});
    }
    case Kind::kVtg: return ready() ? nmea::vtg(talker("GP"), earth_.course_of(motion_of(*estimate_))) : "";
    case Kind::kHdt: return heading_rad_ ? nmea::hdt(talker("HE"), {*heading_rad_}) : "";
    case Kind::kRot: {
      const auto rate = turning_.rate_radps();
      return rate ? nmea::rot(talker("TI"), {*rate}) : "";
    }
    case Kind::kPsxn20: return nmea::psxn_20(quality());
    case Kind::kDpt:
    case Kind::kDbt: {
      if (!altitude_ || !altitude_->valid) return "";
      const nmea::WaterDepth depth{altitude_->range_m, output.transducer_offset_m};
      return kind == Kind::kDpt ? nmea::dpt(talker("SD"), depth) : nmea::dbt(talker("SD"), depth);
    }
    case Kind::kVdo: return ready() ? formats::ais::vdo(report_of(motion_of(*estimate_), turning_, earth_, mmsi_)) : "";
    case Kind::kKmBinary: return ready() && attitude_ ? text_of(formats::km_binary::write(km_sample())) : "";
    case Kind::kPashr:
    case Kind::kPsxn23:
    case Kind::kTss1:
    case Kind::kEmAttitude: return ready() && attitude_ ? motion_sentence(kind) : "";
    case Kind::kZda:         // of the clock
    case Kind::kVdm: break;  // of others
  }
  return "";
}

}  // namespace ensonify::nav_out
