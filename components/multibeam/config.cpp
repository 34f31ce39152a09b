#include "components/multibeam/config.h"

#include <cmath>

#include "components/runtime/config/config_reader.h"
#include "components/runtime/head/effects.h"
#include "components/runtime/head/environment.h"
#include "components/runtime/head/head_motion.h"

namespace ensonify {
namespace {

constexpr double kMostSamples = 20000;  // per beam: 20 MB of ping with 256 beams

void read_array(ConfigReader& from, MultibeamConfig& c) {
  from.optional("frequency_hz", c.frequency_hz, 50e3, 1e6);
  from.optional("beams", c.beams, 2, 1024);
  from.optional("swath_deg", c.swath_rad, 1, 170, kDegrees);
  from.optional_choice(
      "spacing", c.spacing,
      {{"equiangle", MultibeamConfig::Spacing::kEquiangle}, {"equidistant", MultibeamConfig::Spacing::kEquidistant}});
  from.optional("transmit_beamwidth_deg", c.transmit_beamwidth_rad, 0.1, 20, kDegrees);
  from.optional("receive_beamwidth_deg", c.receive_beamwidth_rad, 0.1, 20, kDegrees);
}

void read_ping(ConfigReader& from, MultibeamConfig& c) {
  from.optional("pulse_length_s", c.pulse_length_s, 5e-6, 1e-2);
  from.optional("source_level_db", c.source_level_db, -300, 250);
  from.optional("roll_stabilised", c.roll_stabilised);
  from.optional("pitch_stabilised", c.pitch_stabilised);
  from.optional("attitude_latency_s", c.attitude_latency_s, 0, 1);
  from.optional("auto_range", c.auto_range);
  from.optional("range_m", c.range_m, 1, 2000);
  from.optional("ping_rate_hz", c.ping_rate_hz, 0.01, 100);
  from.optional("dead_time_s", c.dead_time_s, 0, 1);
  from.optional("processing_latency_s", c.processing_latency_s, 0, 10);
  from.optional("sample_rate_hz", c.sample_rate_hz, 1e3, 1e6);
  read_quality(from, c.quality);
  from.optional("detection_threshold_db", c.detection_threshold_db, 0, 60);
  from.optional("amplitude_every", c.amplitude_every, 1, 1'000'000);
}

void check(ConfigReader& from, const MultibeamConfig& c) {
  // The narrowest envelope that a pulse leaves is as long as the pulse: two samples of it, or echoes fall between.
  if (c.sample_rate_hz * c.pulse_length_s < 1.999) {
    from.problem("sample_rate_hz", std::to_string(c.sample_rate_hz) + " is below two samples per pulse, " +
                                       std::to_string(2.0 / c.pulse_length_s) + " Hz");
  }
  if (c.samples(c.range_m) > kMostSamples) {
    from.problem("range_m", "makes " + std::to_string(c.samples(c.range_m)) + " samples per beam; at most " +
                                std::to_string(static_cast<int>(kMostSamples)) +
                                " are allowed: shorten it or lower sample_rate_hz");
  }
}

}  // namespace

MultibeamConfig MultibeamConfig::read(ConfigReader& from, const Scenario& scenario, const std::string& process) {
  MultibeamConfig c;
  read_array(from, c);
  read_ping(from, c);

  c.world = scenario;
  c.process = process;
  c.mounting = read_mounting(from, scenario, process);
  c.sound_speed_mps = applied_profile(scenario).speed_mps(scenario.mission.depth_m);
  check(from, c);
  return c;
}

bool MultibeamConfig::operator==(const MultibeamConfig& o) const {
  return frequency_hz == o.frequency_hz && beams == o.beams && swath_rad == o.swath_rad && spacing == o.spacing &&
         transmit_beamwidth_rad == o.transmit_beamwidth_rad && receive_beamwidth_rad == o.receive_beamwidth_rad &&
         pulse_length_s == o.pulse_length_s && source_level_db == o.source_level_db &&
         roll_stabilised == o.roll_stabilised && pitch_stabilised == o.pitch_stabilised &&
         attitude_latency_s == o.attitude_latency_s && auto_range == o.auto_range && range_m == o.range_m &&
         ping_rate_hz == o.ping_rate_hz && dead_time_s == o.dead_time_s &&
         processing_latency_s == o.processing_latency_s && sample_rate_hz == o.sample_rate_hz && quality == o.quality &&
         detection_threshold_db == o.detection_threshold_db && amplitude_every == o.amplitude_every;
}

Rate MultibeamConfig::ping_rate() const { return {std::llround(ping_rate_hz * 1000.0), 1000}; }

int MultibeamConfig::samples(double of_range_m) const {
  return static_cast<int>(std::ceil((2.0 * of_range_m / sound_speed_mps + pulse_length_s) * sample_rate_hz));
}

}  // namespace ensonify
