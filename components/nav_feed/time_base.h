#pragma once

namespace ensonify {

/// Binds the times of day that a source writes to the run's own time. A time is the day's nearest to when it arrived,
/// so that midnight needs no date, and 1,024 weeks too many change nothing. Behind a second 60 a day is a second
/// longer, if arrivals agree: a sender that only rounded 59.999 up has no leap second.
class TimeBase {
 public:
  bool is_bound() const { return bound_; }
  /// This time of day is `run_s` of the run.
  void bind(double time_of_day_s, double run_s);

  /// The run's time of a time of day, the nearest one to its arrival; bound only.
  double run_s(double time_of_day_s, double arrival_s) const;
  /// By how much a time of day is ahead of its arrival, from -12 h to 12 h; bound only.
  double ahead_s(double time_of_day_s, double arrival_s) const { return run_s(time_of_day_s, arrival_s) - arrival_s; }

  /// The same as run_s, of a time that counts: what is behind it (another day, a leap second) is kept.
  double follow(double time_of_day_s, double arrival_s);
  /// By how much the last time that counted was ahead of its arrival.
  double last_ahead_s() const { return last_ahead_s_; }

 private:
  /// Whole days from the last midnight on to the day of a time of day.
  double days_on(double time_of_day_s, double arrival_s) const;

  bool bound_ = false;
  double midnight_s_ = 0.0;       // the run's time of the day's beginning
  double yesterday_s_ = 86400.0;  // length of the day before
  bool leap_seen_ = false;        // a second 60 has come today
  double last_ahead_s_ = 0.0;
};

}  // namespace ensonify
