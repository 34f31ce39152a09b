#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "components/formats/nmea/navigation.h"
#include "components/nav_feed/config.h"
#include "components/runtime/sim_time.h"
#include "kernels/base/frames/pose.h"
#include "kernels/vehicle/motion/sampled_curve.h"
#include "messages/navigation.h"

namespace ensonify {

/// A vehicle's way as sentences give it. The first fix binds UTC to sim time; from then on the sentences' own times
/// count, and the vehicle is `delay_s` behind them, so that its way is a smooth curve between samples. Fixes are of the
/// antenna, heave of the vehicle's reference point.
class FedTrack {
 public:
  using Count = std::function<void(const std::string&)>;
  FedTrack(const NavFeedConfig& config, const frames::LocalProjection& world, Count count);

  /// Lines that arrived by the event at `now`, good or bad. What cannot be used is counted, and changes nothing.
  void take(std::string_view text, SimTime now);

  /// The vehicle at `now`; nothing before its first fix is that old. Its height is heave alone, or with
  /// NavFeedConfig::Height::kGga that above chart datum.
  std::optional<frames::MovingPose> at(SimTime now) const;
  /// Nothing new has come for long enough that the way is a guess.
  bool lacks_data(SimTime now) const;
  /// Forgets what no later event needs.
  void forget(SimTime now);

  /// The newest fix that was taken since the last call; its place is the antenna's.
  std::optional<msg::Position> take_fix() { return std::exchange(fix_, std::nullopt); }

 private:
  void take(const nmea::Fix& fix, SimTime now);
  void take(const nmea::Heading& heading, SimTime now);
  void take(const nmea::Motion& motion, SimTime now);

  /// A time of day on the way on from the last one, across midnight.
  double unwrapped_s(double time_of_day_s) const;
  /// Time of a sentence that gives none: that of the last one that did, and what has passed since.
  double utc_s_at(SimTime now) const { return sentence_utc_s_ + seconds(now - sentence_at_); }
  void set_utc(double utc_s, SimTime now);
  bool is_complete() const;
  void settle_height();
  motion::Moving height_m(double t_s) const;
  double delayed_s(SimTime now) const { return *anchor_utc_s_ + seconds(now - anchor_) - config_.delay_s; }
  bool push_heading(double utc_s, double true_heading_rad);

  NavFeedConfig config_;
  frames::LocalProjection world_;
  Count count_;
  std::optional<double> anchor_utc_s_;  // UTC at sim time anchor_
  SimTime anchor_{0};
  double sentence_utc_s_ = 0.0;
  SimTime sentence_at_{0};
  bool heading_by_gyro_ = false;  // HDT has come: headings of motion sentences are left
  motion::SampledCurve east_m_, north_m_, heading_rad_, roll_rad_, pitch_rad_, heave_m_;
  motion::SampledCurve mean_height_m_;  // above chart datum, of the reference point without heave; by GGA
  struct AntennaHeight {
    double utc_s, above_datum_m;
  };
  std::optional<AntennaHeight> unsettled_;  // until heave and attitude of its time have come
  std::optional<msg::Position> fix_;
};

}  // namespace ensonify
