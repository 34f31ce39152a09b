#include "components/forward_looking/config.h"

#include "components/runtime/config/config_reader.h"
#include "components/runtime/head/head_motion.h"

namespace ensonify {
namespace {

constexpr FileUnit kDecibelsPerKilometre{1e-3};
constexpr double kWeakest_db = 40.0;  // below the highest source level, that can be set

void read_faces(ConfigReader& from, ForwardLookingConfig& c) {
  from.optional("frequency_hz", c.frequency_hz, 50e3, 3e6);
  from.optional("beams", c.beams, 16, 1024);
  from.optional("aperture_deg", c.aperture_rad, 10, 160, kDegrees);
  from.optional("beamwidth_deg", c.beamwidth_rad, 0.2, 10, kDegrees);
  from.optional("transmit_vertical_deg", c.transmit_vertical_rad, 1, 90, kDegrees);
  from.optional("receive_vertical_deg", c.receive_vertical_rad, 1, 90, kDegrees);
  from.optional("tilt_deg", c.tilt_rad, -90, 90, kDegrees);
  from.optional("electronic_noise_db", c.electronic_noise_db, -200, 150);
}

void read_pulse(ConfigReader& from, ForwardLookingConfig& c) {
  from.optional_choice("pulse", c.pulse.chirp, {{"tone", false}, {"chirp", true}});
  from.optional("pulse_length_s", c.pulse.length_s, 2e-6, 20e-3);
  from.optional("bandwidth_hz", c.pulse.bandwidth_hz, 1e3, 1e6);
  from.optional("most_samples", c.pulse.most_samples, 64, 20000);
  if (!c.pulse.chirp && from.has("bandwidth_hz")) {
    from.problem("bandwidth_hz", "only a chirp sweeps; leave it out or set pulse: chirp");
  }
  from.optional("source_level_db", c.source_level_db, -300, 250);
}

void read_operation(ConfigReader& from, ForwardLookingConfig& c) {
  from.optional("range_m", c.range_m, 0.5, 1000);
  from.optional("longest_range_m", c.longest_range_m, 0.5, 1000);
  if (c.range_m > c.longest_range_m) {
    from.problem("range_m", "is beyond longest_range_m, " + std::to_string(c.longest_range_m) + " m");
  }
  from.optional("ping_rate_hz", c.ping_rate_hz, 0.01, 100);
  from.optional("dead_time_s", c.dead_time_s, 0, 1);
  from.optional("processing_latency_s", c.processing_latency_s, 0, 10);
  from.optional("sound_speed_mps", c.sound_speed_mps, 1300, 1700);
  from.optional("gain_spreading_db", c.gain_spreading_db, 0, 80);
  from.optional("gain_absorption_db_per_km", c.gain_absorption_dbpm, 0, 2000, kDecibelsPerKilometre);
  from.optional("gain_offset_db", c.gain_offset_db, -200, 200);
  read_converter(from, c.converter);
  read_quality(from, c.quality);
  read_trigger(from, c.trigger);
  read_effects(from, c.effects);
}

}  // namespace

ForwardLookingConfig ForwardLookingConfig::read(ConfigReader& from, const Scenario& scenario,
                                                const std::string& process) {
  ForwardLookingConfig c;
  read_faces(from, c);
  read_pulse(from, c);
  read_operation(from, c);
  c.interference = read_interference(from, scenario, process, c.processing_latency_s);
  c.world = scenario;
  c.process = process;
  c.mounting = read_mounting(from, scenario, process);
  return c;
}

bool ForwardLookingConfig::operator==(const ForwardLookingConfig& o) const {
  return frequency_hz == o.frequency_hz && beams == o.beams && aperture_rad == o.aperture_rad &&
         beamwidth_rad == o.beamwidth_rad && transmit_vertical_rad == o.transmit_vertical_rad &&
         receive_vertical_rad == o.receive_vertical_rad && tilt_rad == o.tilt_rad && pulse == o.pulse &&
         source_level_db == o.source_level_db && range_m == o.range_m && longest_range_m == o.longest_range_m &&
         ping_rate_hz == o.ping_rate_hz && dead_time_s == o.dead_time_s &&
         processing_latency_s == o.processing_latency_s && sound_speed_mps == o.sound_speed_mps &&
         electronic_noise_db == o.electronic_noise_db && gain_spreading_db == o.gain_spreading_db &&
         gain_absorption_dbpm == o.gain_absorption_dbpm && gain_offset_db == o.gain_offset_db &&
         converter == o.converter && quality == o.quality && trigger == o.trigger && interference == o.interference &&
         effects == o.effects;
}

HeadSettings ForwardLookingConfig::start() const {
  HeadSettings start;
  start.range_m = range_m;
  start.source_level_db = source_level_db;
  start.gain_spreading_db = effects.tvg ? gain_spreading_db : 0.0;
  start.gain_absorption_dbpm = effects.tvg ? gain_absorption_dbpm : 0.0;
  start.gain_offset_db = gain_offset_db;
  start.swath_rad = aperture_rad;
  start.ping_rate_hz = ping_rate_hz;
  return start;
}

SettingLimits ForwardLookingConfig::limits() const {
  SettingLimits limits;
  limits.range_m = {0.5, longest_range_m};
  limits.source_level_db = {source_level_db - kWeakest_db, source_level_db};
  if (effects.tvg) {
    limits.gain_spreading_db = {0.0, 80.0};
    limits.gain_absorption_dbpm = {0.0, 2.0};
  }
  limits.gain_offset_db = {-200.0, 200.0};
  limits.ping_rate_hz = {0.01, ping_rate_hz};
  return limits;
}

}  // namespace ensonify
