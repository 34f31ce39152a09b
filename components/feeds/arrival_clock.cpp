#include "components/feeds/arrival_clock.h"

#include <utility>

namespace ensonify {
namespace {

constexpr int kDrift = 10'000;  // two clocks drift apart by less than 1 in this

}  // namespace

void ArrivalClock::event(SimTime now, Wall wall) {
  const SimTime ahead = SimTime{wall.time_since_epoch()} - now;
  ahead_ += (now - std::exchange(now_, now)) / kDrift;
  if (!std::exchange(bound_, now > SimTime{0}) || ahead < ahead_ || ahead > ahead_ + kMostLate) ahead_ = ahead;
}

}  // namespace ensonify
