#include "components/steering_feed/ordered_course.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "components/errors/overloaded.h"
#include "kernels/base/frames/attitude.h"
#include "kernels/vehicle/guidance/laws.h"

namespace ensonify {
namespace {

constexpr double kLag_s = 1.2;            // a sentence a second, and the vehicle's reaction
constexpr double kAnotherLeg_rad = 0.02;  // of its bearing; less is the rounding of a sentence

}  // namespace

OrderedCourse::OrderedCourse(const SteeringFeedConfig& config, Count count)
    : config_(config), count_(std::move(count)) {}

void OrderedCourse::take(std::string_view text, SimTime now) {
  nmea::for_each_line(text, [&](std::string_view line) {
    std::visit(Overloaded{[&](const nmea::Other&) { count_("sentences_of_other_kinds"); },
                          [&](const nmea::Empty&) { count_("sentences_without_data"); },
                          [&](const nmea::BadChecksum&) { count_("sentences_with_bad_checksum"); },
                          [&](const nmea::Malformed&) { count_("sentences_malformed"); },
                          [&](const nmea::Warned&) { count_("sentences_not_valid"); },
                          [&](const auto& order) { take(order, now); }},
               nmea::read_steering(line));
  });
}

/// Magnetic bearings need the variation.
std::optional<double> OrderedCourse::true_rad(const nmea::Bearing& bearing) {
  if (!bearing.magnetic) return bearing.rad;
  if (!config_.variation_rad) return std::nullopt;
  return bearing.rad + *config_.variation_rad;
}

void OrderedCourse::take(const nmea::HeadingOrder& order, SimTime now) {
  const auto heading_rad = true_rad(order.heading);
  if (!heading_rad) return count_("bearings_without_variation");
  heading_rad_ = heading_rad;
  leg_.reset();
  taken_at_ = now;
  count_("headings_taken");
}

void OrderedCourse::take(const nmea::LegOrder& order, SimTime now) {
  if (order.leg) {
    const auto bearing_rad = true_rad(*order.leg);
    return bearing_rad ? follow(*bearing_rad, order.off_m, now) : count_("bearings_without_variation");
  }
  if (order.to_end) {  // seen from starboard of the leg its end lies to port of the leg's bearing
    if (std::abs(order.off_m) >= order.to_end_m) return count_("legs_without_a_bearing");
    return follow(order.to_end->rad + std::asin(order.off_m / order.to_end_m), order.off_m, now);
  }
  if (!leg_) return count_("legs_without_a_bearing");
  follow(leg_->true_bearing_rad, order.off_m, now);
}

void OrderedCourse::follow(double true_bearing_rad, double off_m, SimTime now) {
  const bool same = leg_ && std::abs(frames::wrap_pi(true_bearing_rad - leg_->true_bearing_rad)) < kAnotherLeg_rad;
  if (!same) integral_s_ = 0.0;
  heading_rad_.reset();
  leg_ = Leg{true_bearing_rad, off_m};
  taken_at_ = now;
  count_("legs_taken");
}

std::optional<OrderedCourse::Order> OrderedCourse::order(SimTime now, double speed_mps) {
  if (seconds(now - taken_at_) > config_.valid_s) heading_rad_.reset(), leg_.reset();
  if (heading_rad_) return Order{*heading_rad_, true};
  if (!leg_) return std::nullopt;
  const auto gains = guidance::line_gains(std::max(speed_mps, 0.1), kLag_s, config_.lookahead_m);
  integral_s_ = guidance::next_integral_s(gains, leg_->off_m, integral_s_, 1.0 / config_.command_rate_hz);
  return Order{leg_->true_bearing_rad + guidance::course_offset_rad(gains, leg_->off_m, integral_s_), false};
}

}  // namespace ensonify
