#pragma once

#include <vector>

#include "components/config/parameters.h"
#include "components/runtime/sim_time.h"
#include "components/sonar/other_heads.h"

namespace ensonify {

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

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("mode", "", one_of({{"free", Mode::kFree}, {"slave", Mode::kSlave}, {"interleaved", Mode::kInterleaved}}),
          "at the ping rate, after another head's transmissions, or in turns", self.mode);
    visit("offset_s", "s", in(0, 10), "of a slave: after its master's transmission", self.offset_s);
    visit("patience_s", "s", in(0.1, 1000), "of a slave: without its master for longer, health says so",
          self.patience_s);
    visit("cycle_s", "s", in(1e-3, 100), "of heads in turns", self.cycle_s);
    visit("slot_s", "s", in(0, 100), "of this head in turns, from the start of the cycle", self.slot_s);
  }
  void check(const ConfigReader& from) const;
};

/// Ping rate and trigger of a head, and its latency from the last echo to the published ping.
struct PingTiming {
  Rate rate;             // at most
  SimTime dead_time{0};  // between the end of reception and the next transmission, at least
  SimTime processing_latency{0};
  Trigger trigger = {};
  std::vector<OtherHead> others = {};  // that ping beside it, and are received
};

}  // namespace ensonify
