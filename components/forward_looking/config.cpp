#include "components/forward_looking/config.h"

#include "components/config/read_parameters.h"

namespace ensonify {
ForwardLookingConfig ForwardLookingConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  ForwardLookingConfig c;
  read_parameters(from, c);
  c.pulse.check(from);
  if (!c.pulse.chirp && from.has("bandwidth_hz")) {
    from.problem("bandwidth_hz", "only a chirp sweeps; leave it out or set pulse: chirp");
  }
  if (c.range_m > c.longest_range_m) {
    from.problem("range_m", "is beyond longest_range_m, " + std::to_string(c.longest_range_m) + " m");
  }
  place_head(from, world, process, c);
  return c;
}

HeadSettings ForwardLookingConfig::start() const {
  HeadSettings start = start_at(range_m, source_level_db);
  start.swath_rad = aperture_rad;
  return start;
}

SettingLimits ForwardLookingConfig::limits() const {
  SettingLimits limits = limits_up_to(0.5, longest_range_m, source_level_db);
  allow_held_pulses(pulse, sound_speed_mps, limits);
  limits["swath_rad"] = {{aperture_rad, aperture_rad}};
  return limits;
}

}  // namespace ensonify
