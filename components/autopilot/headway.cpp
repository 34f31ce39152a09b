#include "components/autopilot/headway.h"

namespace ensonify {

void Headway::observe(SimTime now, double to_go_m) {
  constexpr double kStep_m = 1.0;
  if (nearest_m_ && to_go_m > *nearest_m_ - kStep_m) return;
  nearest_m_ = to_go_m;
  nearest_at_ = now;
}

}  // namespace ensonify
