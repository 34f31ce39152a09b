#include "examples/profiler/config.h"

#include "components/config/config_reader.h"

namespace ensonify {

ProfilerConfig ProfilerConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  ProfilerConfig config;
  from.optional("frequency_hz", config.frequency_hz, 200e3, 2e6);
  from.optional("beamwidth_deg", config.beamwidth_rad, 0.5, 10, kDegrees);
  from.optional("source_level_db", config.source_level_db, 150, 230);
  from.optional("pulse_length_s", config.pulse_length_s, 10e-6, 1e-3);
  from.optional("range_m", config.range_m, 1, 100);
  read_head(from, world, process, 50.0, config);
  read_sound_speed(from, config);
  return config;
}

bool ProfilerConfig::operator==(const ProfilerConfig& o) const {
  return same_parameters(*this, o) && sound_speed_mps == o.sound_speed_mps && frequency_hz == o.frequency_hz &&
         beamwidth_rad == o.beamwidth_rad && source_level_db == o.source_level_db &&
         pulse_length_s == o.pulse_length_s && range_m == o.range_m;
}

HeadSettings ProfilerConfig::start() const {
  HeadSettings start = start_at(range_m, source_level_db);
  start.pulse_length_s = pulse_length_s;
  return start;
}

}  // namespace ensonify
