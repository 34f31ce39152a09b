#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "components/formats/nmea/navigation.h"
#include "components/nav_feed/config.h"
#include "components/nav_feed/fix_trial.h"
#include "components/nav_feed/time_base.h"
#include "components/runtime/sim_time.h"
#include "kernels/base/frames/pose.h"
#include "kernels/vehicle/motion/gapped_curve.h"
#include "messages/navigation.h"

namespace ensonify {

/// A vehicle's way as sentences give it. Fixes that agree bind the day's time to the run's (TimeBase, FixTrial); from
/// then on the sentences' own times count, and the vehicle is `delay_s` behind them, so that its way is a smooth curve
/// between samples. No sample's time is farther than `time_jump_s` from its arrival. Fixes are of the antenna, heave of
/// the vehicle's reference point.
class FedTrack {
 public:
  using Count = std::function<void(const std::string&)>;
  FedTrack(const NavFeedConfig& config, const frames::LocalProjection& world, Count count);

  /// When and from which of config.sources something came; its latency is taken off already.
  struct Origin {
    SimTime arrival{0};
    std::size_t source = 0;
  };
  /// What a source says, good or bad. What cannot be used is counted, and changes nothing.
  void take(const nmea::Navigation& said, const Origin& origin);

  /// The vehicle at `now`; nothing before its first fix is that old. Its height is heave alone, or with
  /// NavFeedConfig::Height::kGga that above chart datum.
  std::optional<frames::MovingPose> at(SimTime now) const;
  /// Nothing new has come for long enough that the way is a guess.
  bool lacks_data(SimTime now) const;
  /// Why the vehicle is not where a good feed would have it; "": it is.
  std::string trouble(SimTime now) const;
  /// Forgets what no later event needs.
  void forget(SimTime now);

  /// The newest fix that was taken since the last call; its place is the antenna's.
  std::optional<msg::Position> take_fix() { return std::exchange(fix_, std::nullopt); }

 private:
  void use(const nmea::Fix& fix, const Origin& origin);
  void use(const nmea::MinimumFix& minimum, const Origin& origin);
  void use(const nmea::Heading& heading, const Origin& origin);
  void use(const nmea::Motion& motion, const Origin& origin);
  void use(const nmea::MotionQuality& quality, const Origin& origin) { of_source_[origin.source].quality = quality; }
  void use(const nmea::FixAccuracy& accuracy, const Origin&) { accuracy_ = accuracy; }
  void use(const nmea::DateAndTime& date, const Origin& origin);
  void use(const nmea::Datum& datum, const Origin& origin);
  template <class Sentence>
  void use(const Sentence&, const Origin&) {  // of speeds, turn rates and depths: the vehicle follows its places
    count_("sentences_read_only");
  }

  void use_fix(nmea::Fix fix, const Origin& origin);
  void use_date(std::chrono::sys_days date, double time_of_day_s, SimTime now);
  /// A fix that is not used at all, and why: health says so until one is used.
  void refuse(const std::string& counter, const std::string& why);

  ArrivedFix arrived(const nmea::Fix& fix, const Origin& origin);
  /// Whether a fix goes on from those before it; if not, it is counted and the cause is kept.
  bool goes_on(const ArrivedFix& fix);
  void try_fix(const ArrivedFix& fix);
  void follow(const ArrivedFix& fix);
  void settle_height();

  /// Time of what gives none: that of the last of its source that did, and what has passed since.
  double untimed_s(const Origin& origin) const { return seconds(origin.arrival) + of_source_[origin.source].ahead_s; }
  /// Time of what gives one.
  double timed_s(double time_of_day_s, const Origin& origin);
  double delayed_s(SimTime now) const { return seconds(now) - config_.delay_s; }
  bool is_complete() const;
  motion::Moving height_m(double t_s) const;
  bool push_heading(double t_s, double true_heading_rad);
  std::string lack_of_fixes(double t_s) const;

  NavFeedConfig config_;
  frames::LocalProjection world_;
  Count count_;
  TimeBase base_;  // until a fix is accepted that of the first one on trial
  FixTrial trial_;
  std::string jump_;                      // what the fixes on trial are off by, or were before they were accepted
  double jumped_at_s_ = 0.0;              // when the way goes on behind the jump
  bool time_jumped_ = false;              // fixes on trial have another time, not only another place
  double known_height_m_ = 0.0;           // of the last fix that gave one
  std::string refusal_;                   // why the last fix was not used at all; "": it was
  std::optional<double> clock_ahead_s_;   // of the last ZDA, if that is too much
  std::optional<double> motion_ahead_s_;  // of the last motion sentence, if that is too much for it to be taken
  std::optional<double> gyro_newest_s_;   // of HDT, which goes before headings of motion sentences
  frames::Vec3 newest_enu_m_ = frames::Vec3::Zero();  // of the newest fix that was followed
  std::optional<SimTime> gga_at_;                     // its last arrival: RMC gives places only without it
  std::optional<nmea::FixAccuracy> accuracy_;
  std::string datum_ = "W84";  // of the fixes that come
  struct OfSource {
    double ahead_s = 0.0;         // of its arrival, the last time that it gave
    nmea::MotionQuality quality;  // PSXN,20
  };
  std::vector<OfSource> of_source_;
  frames::Vec3 antenna_body_m_ = frames::Vec3::Zero();
  struct Dated {
    double unix_s;
    SimTime arrival;
  };
  std::optional<Dated> dated_;  // the last date and time
  std::string date_jump_;       // what one was off by
  SimTime date_jumped_at_{0};
  // In the run's seconds.
  motion::GappedCurve east_m_, north_m_, heading_rad_, roll_rad_, pitch_rad_, heave_m_;
  motion::GappedCurve mean_height_m_;  // above chart datum, of the reference point without heave; by GGA
  struct AntennaHeight {
    double t_s, above_datum_m;
  };
  std::optional<AntennaHeight> unsettled_;  // until heave and attitude of its time have come
  std::optional<msg::Position> fix_;
};

}  // namespace ensonify
