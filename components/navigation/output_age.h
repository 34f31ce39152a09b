#pragma once

#include <deque>

#include "components/runtime/sim_time.h"
#include "messages/navigation.h"

namespace ensonify {

/// Estimates that are older than their stamps say, as from a system whose outputs take their time to whoever stamps
/// them: east and north by `position`, the rest (height, attitude, velocity) by `motion`. Between estimates they are
/// interpolated; before the first has the age, the first is given. Covariances are those of the stamp.
class OutputAge {
 public:
  OutputAge(SimTime position, SimTime motion) : position_(position), motion_(motion) {}

  msg::Estimate aged(const msg::Estimate& now);

 private:
  msg::Estimate at(std::int64_t t_ns) const;

  SimTime position_, motion_;
  std::deque<msg::Estimate> past_;  // the newest that is old enough for both, and all after it
};

}  // namespace ensonify
