#pragma once

#include <vector>

#include "components/formats/nmea/navigation.h"
#include "components/runtime/sim_time.h"
#include "kernels/base/frames/pose.h"

namespace ensonify {

/// A fix with where it is in the world and when it arrived.
struct ArrivedFix {
  nmea::Fix fix;
  frames::Vec3 position_enu_m = frames::Vec3::Zero();  // of the antenna; its height is 0 where heights do not count
  SimTime arrival{0};
  std::size_t source = 0;
};

/// Fixes on trial: a first fix, and one at another time or place than those before it, counts only when others agree
/// with it. They agree when their times go on as their arrivals do and no speed between them is too high; they are
/// accepted when they are three at least, over a second at least.
class FixTrial {
 public:
  struct Limits {
    double time_jump_s = 0.0;
    double fastest_mps = 0.0;
  };
  explicit FixTrial(const Limits& limits) : limits_(limits) {}

  /// Adds a fix: to the others when it agrees with the newest of them, else alone. One of the same time changes
  /// nothing. Returns how many it gave up for it.
  std::size_t add(const ArrivedFix& fix);
  void clear() { fixes_.clear(); }

  bool is_on() const { return !fixes_.empty(); }
  bool is_accepted() const;
  /// In the order of their times.
  const std::vector<ArrivedFix>& fixes() const { return fixes_; }

 private:
  bool agree(const ArrivedFix& before, const ArrivedFix& after) const;

  Limits limits_;
  std::vector<ArrivedFix> fixes_;
};

}  // namespace ensonify
