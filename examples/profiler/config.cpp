#include "examples/profiler/config.h"

#include "components/config/read_parameters.h"

namespace ensonify {

ProfilerConfig ProfilerConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  ProfilerConfig config;
  read_parameters(from, config);
  place_head(from, world, process, config);
  return config;
}

HeadSettings ProfilerConfig::start() const {
  HeadSettings start = start_at(range_m, source_level_db);
  start.pulse_length_s = pulse_length_s;
  return start;
}

}  // namespace ensonify
