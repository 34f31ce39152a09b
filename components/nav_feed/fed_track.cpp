#include "components/nav_feed/fed_track.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "components/errors/overloaded.h"
#include "components/formats/time_of_day.h"
#include "components/nav_feed/wording.h"
#include "kernels/vehicle/motion/lever.h"
#include "kernels/vehicle/vertical/reduction.h"

namespace ensonify {
namespace {

using formats::kDay_s;

constexpr double kSameTime_s = 0.5e-3;    // times have three decimals at most; it bounds what is kept
constexpr double kAccuracyLasts_s = 2.5;  // GST comes before or behind its GGA, once a second
constexpr SimTime kGgaIsGone = std::chrono::seconds(5);

/// Zero where nothing has come.
motion::Moving value_at(const motion::GappedCurve& curve, double t_s) {
  return curve.empty() ? motion::Moving{} : curve.at(t_s);
}

/// Where a fix would be with latitude and longitude the other way round: with their signs, or where the letters of the
/// hemispheres stayed. Nothing where the longitude is no latitude.
std::vector<frames::Geodetic> swapped(const nmea::Fix& fix) {
  const double latitude_deg = fix.longitude_deg, longitude_deg = fix.latitude_deg;
  if (std::abs(latitude_deg) > 90.0) return {};
  return {{latitude_deg, longitude_deg},
          {std::copysign(latitude_deg, fix.latitude_deg), std::copysign(longitude_deg, fix.longitude_deg)}};
}

}  // namespace

FedTrack::FedTrack(const NavFeedConfig& config, const frames::LocalProjection& world, Count count)
    : config_(config),
      world_(world),
      count_(std::move(count)),
      trial_({config.time_jump_s, config.fastest_mps}),
      of_source_(config.sources.size()),
      east_m_({config.straight_on_s, config.straight_on_s}),
      north_m_({config.straight_on_s, config.straight_on_s}),
      heading_rad_({config.attitude_gap_s, 0.0}),
      roll_rad_({config.attitude_gap_s, 0.0}),
      pitch_rad_({config.attitude_gap_s, 0.0}),
      heave_m_({config.attitude_gap_s, 0.0}),
      mean_height_m_({config.straight_on_s, 0.0}) {
  for (const FeedSource& source : config.sources) {
    if (source.may_give_places()) antenna_body_m_ = source.antenna_body_m;
  }
}

void FedTrack::take(const nmea::Navigation& said, const Origin& origin) {
  std::visit(Overloaded{[&](const nmea::Other&) { count_("sentences_of_other_kinds"); },
                        [&](const nmea::Empty&) { count_("sentences_without_data"); },
                        [&](const nmea::BadChecksum&) { count_("sentences_with_bad_checksum"); },
                        [&](const nmea::Malformed&) { count_("sentences_malformed"); },
                        [&](const auto& sentence) { use(sentence, origin); }},
             said);
}

double FedTrack::timed_s(double time_of_day_s, const Origin& origin) {
  const double arrival_s = seconds(origin.arrival), t_s = base_.follow(time_of_day_s, arrival_s);
  of_source_[origin.source].ahead_s = t_s - arrival_s;
  return t_s;
}

void FedTrack::refuse(const std::string& counter, const std::string& why) {
  count_(counter);
  refusal_ = why + ": not taken";
}

void FedTrack::use(const nmea::Fix& fix, const Origin& origin) {
  gga_at_ = origin.arrival;
  use_fix(fix, origin);
}

void FedTrack::use(const nmea::MinimumFix& minimum, const Origin& origin) {
  if (minimum.fix.quality > 0 && minimum.date) use_date(*minimum.date, minimum.fix.time_s, origin.arrival);
  if (gga_at_ && origin.arrival - *gga_at_ < kGgaIsGone) return count_("sentences_read_only");
  use_fix(minimum.fix, origin);
}

void FedTrack::use_fix(nmea::Fix fix, const Origin& origin) {
  const double arrival_s = seconds(origin.arrival);
  if (config_.sources[origin.source].time_scale == FeedSource::TimeScale::kNone) {
    fix.time_s = arrival_s - kDay_s * std::floor(arrival_s / kDay_s);
  }
  if (fix.quality == 0) return refuse("fixes_invalid", "fixes have quality 0");
  if (datum_ != "W84") return refuse("fixes_on_another_datum", "fixes are on datum " + datum_ + ", not W84");
  const ArrivedFix found = arrived(fix, origin);
  const double off_m = found.position_enu_m.head<2>().norm();
  if (!(off_m < kFarAway_m)) {
    if (std::ranges::any_of(swapped(fix), [&](const auto& at) { return world_.enu_of(at).norm() < kFarAway_m; })) {
      return refuse("fixes_with_latitude_and_longitude_swapped", "latitude and longitude are swapped");
    }
    return refuse("fixes_far_from_the_site", "fixes are " + distance_text(off_m) + " from the site");
  }
  if (!east_m_.empty() && std::abs(base_.ahead_s(fix.time_s, arrival_s)) <= config_.time_jump_s) {
    const double since_s = base_.run_s(fix.time_s, arrival_s) - east_m_.newest_s();
    if (std::abs(since_s) < kSameTime_s) return count_("fixes_double");
    if (since_s < 0.0) return count_("sentences_late");
  }
  refusal_.clear();
  if (!goes_on(found)) return try_fix(found);
  trial_.clear();
  follow(found);
}

void FedTrack::use(const nmea::Datum& datum, const Origin&) {
  datum_ = datum.code;
  count_("datums_taken");
}

void FedTrack::use(const nmea::DateAndTime& date, const Origin& origin) {
  use_date(date.date, date.time_s, origin.arrival);
  clock_ahead_s_.reset();
  if (!base_.is_bound()) return;
  const double ahead_s = base_.ahead_s(date.time_s, seconds(origin.arrival));
  if (std::abs(ahead_s) <= config_.time_jump_s) return;
  clock_ahead_s_ = ahead_s;
  count_("clocks_at_another_time");
}

/// Dates are not used: a time is the day's nearest to its arrival. What goes wrong with them is reported.
void FedTrack::use_date(std::chrono::sys_days date, double time_of_day_s, SimTime now) {
  const double unix_s = kDay_s * static_cast<double>(date.time_since_epoch().count()) + time_of_day_s;
  const auto before = std::exchange(dated_, Dated{unix_s, now});
  count_("dates_taken");
  if (!before) return;
  const double days = std::round((unix_s - before->unix_s - seconds(now - before->arrival)) / kDay_s);
  if (days == 0.0) return;
  count_("dates_jumped");
  date_jumped_at_ = now;
  date_jump_ = std::string("the date jumped ") + (days > 0.0 ? "ahead" : "back") + " by " +
               std::to_string(std::abs(std::lround(days))) + " days: not used";
}

ArrivedFix FedTrack::arrived(const nmea::Fix& fix, const Origin& origin) {
  const frames::Vec2 place = world_.enu_of({fix.latitude_deg, fix.longitude_deg});
  ArrivedFix found{fix, {place.x(), place.y(), 0.0}, origin.arrival, origin.source};
  if (fix.height_above_geoid_m && config_.sources[origin.source].heights_are_of_ellipsoid()) {
    found.fix.height_above_geoid_m = *fix.height_above_geoid_m + fix.geoid_above_ellipsoid_m.value_or(0.0) -
                                     config_.datums.geoid_above_ellipsoid.at(place);
  }
  if (fix.height_above_geoid_m && config_.height == NavFeedConfig::Height::kGga) {
    known_height_m_ =
        *found.fix.height_above_geoid_m - vertical::geoid_height_m(config_.datums, {place.x(), place.y(), 0.0});
  }
  found.position_enu_m.z() = known_height_m_;
  return found;
}

bool FedTrack::goes_on(const ArrivedFix& found) {
  if (east_m_.empty()) return false;
  const double arrival_s = seconds(found.arrival), ahead_s = base_.ahead_s(found.fix.time_s, arrival_s);
  if (std::abs(ahead_s) > config_.time_jump_s) {
    count_("fixes_at_another_time");
    time_jumped_ = true;
    jump_ = std::string("time jumped ") + (ahead_s > 0.0 ? "ahead" : "back") + " by " + duration_text(ahead_s);
    return false;
  }
  const double since_s = arrival_s + ahead_s - east_m_.newest_s();
  const double way_m = (found.position_enu_m - newest_enu_m_).norm();
  if (way_m > config_.fastest_mps * since_s) {
    count_("fixes_beyond_the_fastest_speed");
    time_jumped_ = false;
    jump_ = "place jumped by " + distance_text(way_m);
    return false;
  }
  return true;
}

/// A first fix, or one that does not go on from those before it.
void FedTrack::try_fix(const ArrivedFix& found) {
  const bool first = east_m_.empty();
  for (std::size_t given_up = trial_.add(found); given_up > 0; --given_up) count_("fixes_that_none_agreed_with");
  const ArrivedFix& oldest = trial_.fixes().front();
  if (first) base_.bind(oldest.fix.time_s, seconds(oldest.arrival));
  if (!trial_.is_accepted()) return;
  if (!first) {
    count_(time_jumped_ ? "time_jumps" : "place_jumps");
    if (time_jumped_) base_.bind(oldest.fix.time_s, seconds(oldest.arrival));
    motion_ahead_s_.reset();
    settle_height();
    for (auto* curve : {&east_m_, &north_m_, &mean_height_m_}) curve->interrupt();
    jumped_at_s_ = base_.run_s(oldest.fix.time_s, seconds(oldest.arrival));
  }
  for (const ArrivedFix& fix : trial_.fixes()) follow(fix);
  trial_.clear();
}

void FedTrack::follow(const ArrivedFix& found) {
  const nmea::Fix& fix = found.fix;
  const double t_s = timed_s(fix.time_s, {found.arrival, found.source});
  if (!east_m_.push(t_s, found.position_enu_m.x())) return count_("sentences_late");
  north_m_.push(t_s, found.position_enu_m.y());
  newest_enu_m_ = found.position_enu_m;
  count_("fixes_taken");
  if (config_.height == NavFeedConfig::Height::kGga) {
    settle_height();
    if (!fix.height_above_geoid_m) count_("fixes_without_height");
    if (fix.height_above_geoid_m) unsettled_ = {t_s, found.position_enu_m.z()};
  }

  fix_.emplace();
  fix_->stamp_ns = from_seconds(t_s + config_.delay_s).count();
  const frames::Vec2 place = newest_enu_m_.head<2>();
  fix_->position_enu_m = {place.x(), place.y(), 0.0};
  if (fix.height_above_geoid_m) {
    fix_->position_enu_m[2] =
        *fix.height_above_geoid_m - vertical::geoid_height_m(config_.datums, {place.x(), place.y(), 0.0});
    fix_->height_above_geoid_m = *fix.height_above_geoid_m;
  }
  fix_->geoid_above_ellipsoid_m = fix.geoid_above_ellipsoid_m.value_or(0.0);
  if (accuracy_ && std::abs(formats::time_of_day_step_s(accuracy_->time_s, fix.time_s)) < kAccuracyLasts_s) {
    fix_->sigma_horizontal_m = std::hypot(accuracy_->latitude_m, accuracy_->longitude_m) / std::sqrt(2.0);
    fix_->sigma_vertical_m = accuracy_->height_m.value_or(0.0);
  }
  fix_->latitude_deg = fix.latitude_deg;
  fix_->longitude_deg = fix.longitude_deg;
  fix_->quality = fix.quality;
  fix_->hdop = fix.hdop;
}

/// The height of the fix before: all that was said of its time has come with the one after it.
void FedTrack::settle_height() {
  if (!unsettled_) return;
  const auto [t_s, above_datum_m] = *std::exchange(unsettled_, std::nullopt);
  const frames::Attitude tilt{0.0, value_at(pitch_rad_, t_s).value, value_at(roll_rad_, t_s).value};
  const double antenna_above_m = (frames::enu_from_body(tilt) * antenna_body_m_).z();
  mean_height_m_.push(t_s, above_datum_m - antenna_above_m - value_at(heave_m_, t_s).value);
}

motion::Moving FedTrack::height_m(double t_s) const { return value_at(mean_height_m_, t_s) + value_at(heave_m_, t_s); }

bool FedTrack::push_heading(double t_s, double true_heading_rad) {
  const frames::Vec3 place = trial_.is_on() && east_m_.empty() ? trial_.fixes().back().position_enu_m : newest_enu_m_;
  const double grid_rad = true_heading_rad - world_.convergence_rad(place.head<2>());
  const double before_rad = heading_rad_.empty() ? grid_rad : heading_rad_.newest();
  if (!heading_rad_.empty() && t_s - heading_rad_.newest_s() < kSameTime_s) return false;
  return heading_rad_.push(t_s, before_rad + frames::wrap_pi(grid_rad - before_rad));
}

void FedTrack::use(const nmea::Heading& heading, const Origin& origin) {
  if (!base_.is_bound()) return count_("sentences_before_the_first_fix");
  const double t_s = untimed_s(origin);
  gyro_newest_s_ = t_s;
  count_(push_heading(t_s, heading.true_heading_rad) ? "headings_taken" : "sentences_late");
}

void FedTrack::use(const nmea::Motion& motion, const Origin& origin) {
  if (!base_.is_bound()) return count_("sentences_before_the_first_fix");
  if (motion.time_s) {
    const double ahead_s = base_.ahead_s(*motion.time_s, seconds(origin.arrival));
    motion_ahead_s_.reset();
    if (std::abs(ahead_s) > config_.time_jump_s) {
      motion_ahead_s_ = ahead_s;
      return count_("motions_at_another_time");
    }
  }
  const double t_s = motion.time_s ? timed_s(*motion.time_s, origin) : untimed_s(origin);
  const nmea::MotionQuality quality = motion.time_s ? nmea::MotionQuality{} : of_source_[origin.source].quality;
  bool any = false, late = false;
  const auto push = [&](motion::GappedCurve& curve, const std::optional<double>& value, bool good) {
    if (!value || !good) return;
    const bool soon = !curve.empty() && t_s - curve.newest_s() < kSameTime_s;
    (!soon && curve.push(t_s, *value) ? any : late) = true;
  };
  push(roll_rad_, motion.roll_rad, quality.roll_and_pitch);
  push(pitch_rad_, motion.pitch_rad, quality.roll_and_pitch);
  push(heave_m_, motion.heave_m, quality.heave);
  const bool by_gyro = gyro_newest_s_ && t_s - *gyro_newest_s_ <= config_.attitude_gap_s;
  if (motion.true_heading_rad && quality.heading && !by_gyro) {
    (push_heading(t_s, *motion.true_heading_rad) ? any : late) = true;
  }
  count_(any ? "motions_taken" : late ? "sentences_late" : "motions_without_use");
}

/// Whether all that a pose takes has come once.
bool FedTrack::is_complete() const {
  const bool high = config_.height == NavFeedConfig::Height::kWater || !mean_height_m_.empty();
  return !east_m_.empty() && !heading_rad_.empty() && high;
}

std::optional<frames::MovingPose> FedTrack::at(SimTime now) const {
  if (!is_complete() || delayed_s(now) < east_m_.oldest_s()) return std::nullopt;
  const double t_s = delayed_s(now);
  // Off a body that lies level at the world's origin with its bow to north. First as if it were at the antenna.
  const motion::Excursion way{north_m_.at(t_s),         east_m_.at(t_s),           height_m(t_s),
                              value_at(roll_rad_, t_s), value_at(pitch_rad_, t_s), heading_rad_.at(t_s)};
  const frames::MovingPose of_antenna = motion::superimpose(frames::MovingPose{}, way);
  frames::MovingPose moving = motion::reference_point(of_antenna, antenna_body_m_);
  moving.pose.position_enu_m.z() = of_antenna.pose.position_enu_m.z();  // heights are the reference point's already
  moving.velocity_enu_mps.z() = of_antenna.velocity_enu_mps.z();
  moving.acceleration_enu_mps2.z() = of_antenna.acceleration_enu_mps2.z();
  return moving;
}

bool FedTrack::lacks_data(SimTime now) const { return !is_complete() || delayed_s(now) > east_m_.newest_s(); }

void FedTrack::forget(SimTime now) {
  for (auto* curve : {&east_m_, &north_m_, &heading_rad_, &roll_rad_, &pitch_rad_, &heave_m_, &mean_height_m_}) {
    curve->forget_before(delayed_s(now));
  }
}

}  // namespace ensonify
