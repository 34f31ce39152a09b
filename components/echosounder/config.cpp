#include "components/echosounder/config.h"

#include <cmath>

#include "components/config/config_reader.h"
#include "components/sonar/ranged_pulse.h"
#include "components/sonar/tone_shape.h"

namespace ensonify {
namespace {

constexpr double kFastest_hz = 100.0;
constexpr double kLongestPulse_s = 20e-3;
constexpr int kMostSamples = 600'000;  // 2.4 MB of ping

}  // namespace

EchosounderConfig EchosounderConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  EchosounderConfig c;
  from.optional("frequency_hz", c.frequency_hz, 20e3, 1e6);
  from.optional_choice("face", c.face, {{"circular", Face::kCircular}, {"square", Face::kSquare}});
  from.optional("beamwidth_deg", c.beamwidth_rad, 0.5, 40, kDegrees);
  from.optional("source_level_db", c.source_level_db, -300, 250);
  from.optional("pulse_length_s", c.pulse_length_s, 10e-6, kLongestPulse_s);
  read_taper(from, false, c.tapered_fraction);
  from.optional("samples_per_pulse", c.samples_per_pulse, kFewestPerPulse, kMostPerPulse);
  from.optional("range_m", c.range_m, 1, 2000);
  from.optional("electronic_noise_db", c.electronic_noise_db, -200, 150);
  from.optional("bottom_threshold_db", c.bottom_threshold_db, 3, 40);
  from.optional("least_range_m", c.least_range_m, kLeastColumn_m, 2000);
  read_head(from, world, process, kFastest_hz, c);
  read_sound_speed(from, c);
  const double samples = c.reception_s(c.start()) / c.sample_period_s();
  if (samples > kMostSamples) {
    from.problem("range_m", "makes " + std::to_string(std::llround(samples)) + " samples; at most " +
                                std::to_string(kMostSamples) + " are allowed: shorten it or lower samples_per_pulse");
  }
  return c;
}

bool EchosounderConfig::operator==(const EchosounderConfig& o) const {
  return same_parameters(*this, o) && sound_speed_mps == o.sound_speed_mps && frequency_hz == o.frequency_hz &&
         face == o.face && beamwidth_rad == o.beamwidth_rad && source_level_db == o.source_level_db &&
         pulse_length_s == o.pulse_length_s && tapered_fraction == o.tapered_fraction &&
         samples_per_pulse == o.samples_per_pulse && range_m == o.range_m &&
         electronic_noise_db == o.electronic_noise_db && bottom_threshold_db == o.bottom_threshold_db &&
         least_range_m == o.least_range_m;
}

HeadSettings EchosounderConfig::start() const {
  HeadSettings start = start_at(range_m, source_level_db);
  start.pulse_length_s = pulse_length_s;
  return start;
}

SettingLimits EchosounderConfig::limits() const {
  SettingLimits limits = limits_up_to(1.0, range_m, source_level_db);
  limits.pulse_length_s = {pulse_length_s, kLongestPulse_s};  // samples come as often as the configured one needs
  return limits;
}

}  // namespace ensonify
