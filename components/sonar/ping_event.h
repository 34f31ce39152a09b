#pragma once

#include <cstdint>
#include <vector>

#include "components/runtime/sim_time.h"
#include "kernels/acoustics/echo/interference.h"

namespace ensonify {

/// One transmission: its number, when it left and how far it is received.
struct PingEvent {
  std::int64_t ping = 0;
  SimTime transmit{0};
  double range_m = 0.0;
  std::vector<echo::InterferingTransmission> interfering = {};  // what other heads send meanwhile
};

}  // namespace ensonify
