#include "components/echosounder/config.h"

#include "components/runtime/config/config_reader.h"
#include "components/runtime/head/head_motion.h"

namespace ensonify {
namespace {

constexpr FileUnit kDecibelsPerKilometre{1e-3};
constexpr double kLongestPulse_s = 20e-3;
constexpr double kWeakest_db = 40.0;  // below the highest source level, that can be set

}  // namespace

EchosounderConfig EchosounderConfig::read(ConfigReader& from, const Scenario& scenario, const std::string& process) {
  EchosounderConfig c;
  from.optional("frequency_hz", c.frequency_hz, 20e3, 1e6);
  from.optional_choice("face", c.face, {{"circular", Face::kCircular}, {"square", Face::kSquare}});
  from.optional("beamwidth_deg", c.beamwidth_rad, 0.5, 40, kDegrees);
  from.optional("source_level_db", c.source_level_db, -300, 250);
  from.optional("pulse_length_s", c.pulse_length_s, 10e-6, kLongestPulse_s);
  from.optional("range_m", c.range_m, 1, 2000);
  from.optional("ping_rate_hz", c.ping_rate_hz, 0.01, 100);
  from.optional("dead_time_s", c.dead_time_s, 0, 1);
  from.optional("processing_latency_s", c.processing_latency_s, 0, 10);
  from.optional("sound_speed_mps", c.sound_speed_mps, 1300, 1700);
  from.optional("gain_spreading_db", c.gain_spreading_db, 0, 80);
  from.optional("gain_absorption_db_per_km", c.gain_absorption_dbpm, 0, 2000, kDecibelsPerKilometre);
  from.optional("gain_offset_db", c.gain_offset_db, -200, 200);
  read_converter(from, c.converter);
  from.optional("electronic_noise_db", c.electronic_noise_db, -200, 150);
  from.optional("bottom_threshold_db", c.bottom_threshold_db, 3, 40);
  read_quality(from, c.quality);
  read_trigger(from, c.trigger);
  c.interference = read_interference(from, scenario, process, c.processing_latency_s);
  read_effects(from, c.effects);
  c.world = scenario;
  c.process = process;
  c.mounting = read_mounting(from, scenario, process);
  return c;
}

bool EchosounderConfig::operator==(const EchosounderConfig& o) const {
  return frequency_hz == o.frequency_hz && face == o.face && beamwidth_rad == o.beamwidth_rad &&
         source_level_db == o.source_level_db && pulse_length_s == o.pulse_length_s && range_m == o.range_m &&
         ping_rate_hz == o.ping_rate_hz && dead_time_s == o.dead_time_s &&
         processing_latency_s == o.processing_latency_s && sound_speed_mps == o.sound_speed_mps &&
         gain_spreading_db == o.gain_spreading_db && gain_absorption_dbpm == o.gain_absorption_dbpm &&
         gain_offset_db == o.gain_offset_db && converter == o.converter &&
         electronic_noise_db == o.electronic_noise_db && bottom_threshold_db == o.bottom_threshold_db &&
         quality == o.quality && trigger == o.trigger && interference == o.interference && effects == o.effects;
}

HeadSettings EchosounderConfig::start() const {
  HeadSettings start;
  start.range_m = range_m;
  start.source_level_db = source_level_db;
  start.pulse_length_s = pulse_length_s;
  start.gain_spreading_db = effects.tvg ? gain_spreading_db : 0.0;
  start.gain_absorption_dbpm = effects.tvg ? gain_absorption_dbpm : 0.0;
  start.gain_offset_db = gain_offset_db;
  start.ping_rate_hz = ping_rate_hz;
  return start;
}

SettingLimits EchosounderConfig::limits() const {
  SettingLimits limits;
  limits.range_m = {1.0, range_m};
  limits.source_level_db = {source_level_db - kWeakest_db, source_level_db};
  limits.pulse_length_s = {pulse_length_s, kLongestPulse_s};  // samples come as often as the configured one needs
  if (effects.tvg) {
    limits.gain_spreading_db = {0.0, 80.0};
    limits.gain_absorption_dbpm = {0.0, 2.0};
  }
  limits.gain_offset_db = {-200.0, 200.0};
  limits.ping_rate_hz = {0.01, ping_rate_hz};
  return limits;
}

}  // namespace ensonify
