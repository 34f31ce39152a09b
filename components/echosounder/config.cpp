#include "components/echosounder/config.h"

#include <cmath>

#include "components/config/read_parameters.h"

namespace ensonify {
namespace {

constexpr int kMostSamples = 600'000;  // 2.4 MB of ping

}  // namespace

EchosounderConfig EchosounderConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  EchosounderConfig c;
  read_parameters(from, c);
  place_head(from, world, process, c);
  const double samples = c.reception_s(c.start()) / c.sample_period_s();
  if (samples > kMostSamples) {
    from.problem("range_m", "makes " + std::to_string(std::llround(samples)) + " samples; at most " +
                                std::to_string(kMostSamples) + " are allowed: shorten it or lower samples_per_pulse");
  }
  return c;
}

HeadSettings EchosounderConfig::start() const {
  HeadSettings start = start_at(range_m, source_level_db);
  start.pulse_length_s = pulse_length_s;
  return start;
}

SettingLimits EchosounderConfig::limits() const {
  SettingLimits limits = limits_up_to(1.0, range_m, source_level_db);
  limits["pulse_length_s"] = {{pulse_length_s, kLongestPulse_s}};  // samples come as often as the configured one needs
  return limits;
}

}  // namespace ensonify
