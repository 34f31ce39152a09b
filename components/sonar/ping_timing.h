#pragma once

#include <vector>

#include "components/runtime/sim_time.h"
#include "components/sonar/other_heads.h"

namespace ensonify {

class ConfigReader;

/// Trigger of a head's transmissions.
struct Trigger {
  enum class Mode {
    kFree,         // the beat of its own ping rate
    kSlave,        // each transmission of another head, its master
    kInterleaved,  // its slot of a cycle that several heads share
  };
  Mode mode = Mode::kFree;
  double offset_s = 0.0;    // slave: from the master's transmission to its own
  double patience_s = 2.0;  // slave: without a master for longer, health says so
  double cycle_s = 0.2;     // interleaved
  double slot_s = 0.0;      // interleaved: of this head, from the start of the cycle; the first starts with the run

  bool operator==(const Trigger&) const = default;
};

/// Reads the section `trigger:`; left out, the head runs free.
void read_trigger(ConfigReader& from, Trigger& trigger);

/// Ping rate and trigger of a head, and its latency from the last echo to the published ping.
struct PingTiming {
  Rate rate;             // at most
  SimTime dead_time{0};  // between the end of reception and the next transmission, at least
  SimTime processing_latency{0};
  Trigger trigger = {};
  std::vector<OtherHead> others = {};  // that ping beside it, and are received
};

}  // namespace ensonify
