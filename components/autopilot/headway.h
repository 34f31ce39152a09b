#pragma once

#include <optional>

#include "components/runtime/sim_time.h"

namespace ensonify {

/// Whether a vehicle still comes nearer to where it should go. One that faces a current as fast as itself does
/// not, and would be under way for ever.
class Headway {
 public:
  /// A metre within `patience_s` is headway; 0: every vehicle is waited for.
  explicit Headway(double patience_s) : patience_s_(patience_s) {}

  /// Another goal, or nothing to go to.
  void start_anew() { nearest_m_.reset(); }
  /// The way to go now. A way that had to be begun again counts from the nearest that the vehicle ever was.
  void observe(SimTime now, double to_go_m);

  bool held_up(SimTime now) const { return none_for(now, 0.1 * patience_s_); }
  bool lost(SimTime now) const { return none_for(now, patience_s_); }

 private:
  bool none_for(SimTime now, double time_s) const {
    return time_s > 0.0 && nearest_m_ && seconds(now - nearest_at_) >= time_s;
  }

  double patience_s_;
  std::optional<double> nearest_m_;
  SimTime nearest_at_{0};
};

}  // namespace ensonify
