#include "components/forward_looking/config.h"

#include "components/config/config_reader.h"
#include "components/sonar/line_shading.h"

namespace ensonify {
namespace {

constexpr double kFastest_hz = 100.0;

void read_faces(ConfigReader& from, ForwardLookingConfig& c) {
  from.optional("frequency_hz", c.frequency_hz, 50e3, 3e6);
  from.optional("beams", c.beams, 16, 1024);
  from.optional("aperture_deg", c.aperture_rad, 10, 160, kDegrees);
  from.optional("beamwidth_deg", c.beamwidth_rad, 0.2, 10, kDegrees);
  read_shading(from, "shading", c.shading);
  from.optional("transmit_vertical_deg", c.transmit_vertical_rad, 1, 90, kDegrees);
  from.optional("receive_vertical_deg", c.receive_vertical_rad, 1, 90, kDegrees);
  from.optional("tilt_deg", c.tilt_rad, -90, 90, kDegrees);
  from.optional("electronic_noise_db", c.electronic_noise_db, -200, 150);
}

void read_transmission(ConfigReader& from, ForwardLookingConfig& c) {
  from.optional_choice("pulse", c.pulse.chirp, {{"tone", false}, {"chirp", true}});
  from.optional("bandwidth_hz", c.pulse.bandwidth_hz, 1e3, 1e6);
  read_window(from, c.pulse.window);
  read_pulse(from, c.pulse);
  if (!c.pulse.chirp && from.has("bandwidth_hz")) {
    from.problem("bandwidth_hz", "only a chirp sweeps; leave it out or set pulse: chirp");
  }
  from.optional("source_level_db", c.source_level_db, -300, 250);
}

void read_ranges(ConfigReader& from, ForwardLookingConfig& c) {
  from.optional("range_m", c.range_m, 0.5, 1000);
  from.optional("longest_range_m", c.longest_range_m, 0.5, 1000);
  if (c.range_m > c.longest_range_m) {
    from.problem("range_m", "is beyond longest_range_m, " + std::to_string(c.longest_range_m) + " m");
  }
}

}  // namespace

ForwardLookingConfig ForwardLookingConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  ForwardLookingConfig c;
  read_faces(from, c);
  read_transmission(from, c);
  read_ranges(from, c);
  read_head(from, world, process, kFastest_hz, c);
  read_sound_speed(from, c);
  return c;
}

bool ForwardLookingConfig::operator==(const ForwardLookingConfig& o) const {
  return same_parameters(*this, o) && sound_speed_mps == o.sound_speed_mps && frequency_hz == o.frequency_hz &&
         beams == o.beams && aperture_rad == o.aperture_rad && beamwidth_rad == o.beamwidth_rad &&
         shading == o.shading && transmit_vertical_rad == o.transmit_vertical_rad &&
         receive_vertical_rad == o.receive_vertical_rad && tilt_rad == o.tilt_rad && pulse == o.pulse &&
         source_level_db == o.source_level_db && range_m == o.range_m && longest_range_m == o.longest_range_m &&
         electronic_noise_db == o.electronic_noise_db;
}

HeadSettings ForwardLookingConfig::start() const {
  HeadSettings start = start_at(range_m, source_level_db);
  start.swath_rad = aperture_rad;
  return start;
}

SettingLimits ForwardLookingConfig::limits() const {
  SettingLimits limits = limits_up_to(0.5, longest_range_m, source_level_db);
  allow_held_pulses(pulse, sound_speed_mps, limits);
  limits.swath_rad = {aperture_rad, aperture_rad};
  return limits;
}

}  // namespace ensonify
