#include "components/sonar/ping_timing.h"

#include <fmt/format.h>

#include "components/config/config_reader.h"

namespace ensonify {

void Trigger::check(const ConfigReader& from) const {
  if (slot_s >= cycle_s) {
    from.problem("slot_s", fmt::format("{} s does not lie in the cycle of {} s", slot_s, cycle_s));
  }
}

}  // namespace ensonify
