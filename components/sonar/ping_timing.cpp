#include "components/sonar/ping_timing.h"

#include <fmt/format.h>

#include "components/config/config_reader.h"

namespace ensonify {

void read_trigger(ConfigReader& from, Trigger& trigger) {
  auto section = from.optional_section("trigger");
  if (!section) return;
  using Mode = Trigger::Mode;
  section->optional_choice("mode", trigger.mode,
                           {{"free", Mode::kFree}, {"slave", Mode::kSlave}, {"interleaved", Mode::kInterleaved}});
  section->optional("offset_s", trigger.offset_s, 0, 10);
  section->optional("patience_s", trigger.patience_s, 0.1, 1000);
  section->optional("cycle_s", trigger.cycle_s, 1e-3, 100);
  section->optional("slot_s", trigger.slot_s, 0, 100);
  if (trigger.slot_s >= trigger.cycle_s) {
    section->problem("slot_s", fmt::format("{} s does not lie in the cycle of {} s", trigger.slot_s, trigger.cycle_s));
  }
}

}  // namespace ensonify
