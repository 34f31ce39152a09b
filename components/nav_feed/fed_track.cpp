#include "components/nav_feed/fed_track.h"

#include <algorithm>
#include <cmath>

#include "components/errors/overloaded.h"
#include "kernels/vehicle/vertical/reduction.h"

namespace ensonify {
namespace {

constexpr double kDay_s = 86400.0;

/// Outside what is known an attitude stays; only the way goes on.
motion::Moving held(const motion::SampledCurve& curve, double t_s) {
  if (curve.size() == 0) return {};
  const bool known = t_s >= curve.oldest_s() && t_s <= curve.newest_s();
  return known ? curve.at(t_s) : motion::Moving{curve.at(std::clamp(t_s, curve.oldest_s(), curve.newest_s())).value};
}

}  // namespace

FedTrack::FedTrack(const NavFeedConfig& config, const frames::LocalProjection& world, Count count)
    : config_(config), world_(world), count_(std::move(count)) {}

void FedTrack::take(std::string_view text, SimTime now) {
  nmea::for_each_line(text, [&](std::string_view line) {
    std::visit(Overloaded{[&](const nmea::Other&) { count_("sentences_of_other_kinds"); },
                          [&](const nmea::Empty&) { count_("sentences_without_data"); },
                          [&](const nmea::BadChecksum&) { count_("sentences_with_bad_checksum"); },
                          [&](const nmea::Malformed&) { count_("sentences_malformed"); },
                          [&](const auto& sentence) { take(sentence, now); }},
               nmea::read_navigation(line));
  });
}

double FedTrack::unwrapped_s(double time_of_day_s) const {
  if (!anchor_utc_s_) return time_of_day_s;
  const double days = std::round((sentence_utc_s_ - time_of_day_s) / kDay_s);
  return time_of_day_s + kDay_s * days;
}

void FedTrack::set_utc(double utc_s, SimTime now) {
  sentence_utc_s_ = utc_s;
  sentence_at_ = now;
}

void FedTrack::take(const nmea::Fix& fix, SimTime now) {
  if (fix.quality == 0) return count_("fixes_invalid");
  const frames::Vec2 place = world_.enu_of({fix.latitude_deg, fix.longitude_deg});
  if (!(place.norm() < kFarAway_m)) return count_("fixes_far_from_the_site");
  const double utc_s = unwrapped_s(fix.time_s);
  if (east_m_.size() > 0) {
    const double since_s = utc_s - east_m_.newest_s();
    if (since_s <= 0.0) return count_("sentences_late");
    const frames::Vec2 way = place - frames::Vec2(east_m_.newest(), north_m_.newest());
    if (way.norm() > config_.fastest_mps * since_s) return count_("fixes_beyond_the_fastest_speed");
  }
  if (!anchor_utc_s_) {
    anchor_utc_s_ = utc_s;
    anchor_ = now;
  }
  set_utc(utc_s, now);
  east_m_.push(utc_s, place.x());
  north_m_.push(utc_s, place.y());
  count_("fixes_taken");
  const double datum_above_geoid_m = vertical::geoid_height_m(config_.datums, {place.x(), place.y(), 0.0});
  if (config_.height == NavFeedConfig::Height::kGga) {
    settle_height();
    if (!fix.height_above_geoid_m) count_("fixes_without_height");
    if (fix.height_above_geoid_m) unsettled_ = {utc_s, *fix.height_above_geoid_m - datum_above_geoid_m};
  }

  fix_.emplace();
  fix_->stamp_ns = (anchor_ + from_seconds(utc_s - *anchor_utc_s_ + config_.delay_s)).count();
  fix_->position_enu_m = {place.x(), place.y(), 0.0};
  if (fix.height_above_geoid_m) {
    fix_->position_enu_m[2] = *fix.height_above_geoid_m - datum_above_geoid_m;
    fix_->height_above_geoid_m = *fix.height_above_geoid_m;
  }
  fix_->latitude_deg = fix.latitude_deg;
  fix_->longitude_deg = fix.longitude_deg;
  fix_->quality = fix.quality;
  fix_->hdop = fix.hdop;
}

/// The height of the fix before: all that was said of its time has come with the one after it.
void FedTrack::settle_height() {
  if (!unsettled_) return;
  const auto [utc_s, above_datum_m] = *std::exchange(unsettled_, std::nullopt);
  const frames::Attitude tilt{0.0, held(pitch_rad_, utc_s).value, held(roll_rad_, utc_s).value};
  const double antenna_above_m = (frames::enu_from_body(tilt) * config_.antenna_body_m).z();
  mean_height_m_.push(utc_s, above_datum_m - antenna_above_m - held(heave_m_, utc_s).value);
}

motion::Moving FedTrack::height_m(double t_s) const { return held(mean_height_m_, t_s) + held(heave_m_, t_s); }

bool FedTrack::push_heading(double utc_s, double true_heading_rad) {
  const frames::Vec2 place(east_m_.newest(), north_m_.newest());
  const double grid_rad = true_heading_rad - world_.convergence_rad(place);
  const double before_rad = heading_rad_.size() == 0 ? grid_rad : heading_rad_.newest();
  return heading_rad_.push(utc_s, before_rad + frames::wrap_pi(grid_rad - before_rad));
}

void FedTrack::take(const nmea::Heading& heading, SimTime now) {
  if (!anchor_utc_s_) return count_("sentences_before_the_first_fix");
  heading_by_gyro_ = true;
  count_(push_heading(utc_s_at(now), heading.true_heading_rad) ? "headings_taken" : "sentences_late");
}

void FedTrack::take(const nmea::Motion& motion, SimTime now) {
  if (!anchor_utc_s_) return count_("sentences_before_the_first_fix");
  const double utc_s = motion.time_s ? unwrapped_s(*motion.time_s) : utc_s_at(now);
  if (!roll_rad_.push(utc_s, motion.roll_rad)) return count_("sentences_late");
  pitch_rad_.push(utc_s, motion.pitch_rad);
  heave_m_.push(utc_s, motion.heave_m);
  if (motion.true_heading_rad && !heading_by_gyro_) push_heading(utc_s, *motion.true_heading_rad);
  if (motion.time_s) set_utc(utc_s, now);
  count_("motions_taken");
}

/// Whether all that a pose takes has come once.
bool FedTrack::is_complete() const {
  const bool high = config_.height == NavFeedConfig::Height::kWater || mean_height_m_.size() > 0;
  return anchor_utc_s_ && heading_rad_.size() > 0 && high;
}

std::optional<frames::MovingPose> FedTrack::at(SimTime now) const {
  if (!is_complete() || delayed_s(now) < east_m_.oldest_s()) return std::nullopt;
  const double t_s = delayed_s(now);
  // Off a body that lies level at the world's origin with its bow to north. First as if it were at the antenna.
  const motion::Excursion way{north_m_.at(t_s),     east_m_.at(t_s),       height_m(t_s),
                              held(roll_rad_, t_s), held(pitch_rad_, t_s), held(heading_rad_, t_s)};
  frames::MovingPose moving = motion::superimpose(frames::MovingPose{}, way);
  const frames::Vec3 &rate = moving.angular_rate_body_radps, &lever = config_.antenna_body_m;
  const auto across = [&](const frames::Vec3& body) { return (moving.pose.enu_from_body * body).head<2>().eval(); };
  moving.pose.position_enu_m.head<2>() -= across(lever);
  moving.velocity_enu_mps.head<2>() -= across(rate.cross(lever));
  moving.acceleration_enu_mps2.head<2>() -=
      across(moving.angular_acceleration_body_radps2.cross(lever) + rate.cross(rate.cross(lever)));
  return moving;
}

bool FedTrack::lacks_data(SimTime now) const { return !is_complete() || delayed_s(now) > east_m_.newest_s(); }

void FedTrack::forget(SimTime now) {
  if (!anchor_utc_s_) return;
  const double t_s = delayed_s(now);
  for (auto* curve : {&east_m_, &north_m_, &heading_rad_, &roll_rad_, &pitch_rad_, &heave_m_, &mean_height_m_}) {
    curve->forget_before(t_s);
  }
}

}  // namespace ensonify
