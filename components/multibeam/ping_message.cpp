#include "components/multibeam/ping_message.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "components/sonar/ranged_pulse.h"
#include "components/sonar/samples.h"

namespace ensonify {
namespace {

/// Of starboard over port, in the layout of the amplitudes.
std::shared_ptr<std::vector<float>> phase_rad(const PingImage& image) {
  auto phase = std::make_shared<std::vector<float>>(image.amplitude_upa->size());
  std::size_t first = 0;
  for (const SectorBeams& beams : image.sectors) {
    const auto& halves = beams.halves;
    tbb::parallel_for(std::size_t{0}, halves.positive_upa.size(), [&](std::size_t i) {
      (*phase)[first + i] = std::arg(halves.positive_upa[i] * std::conj(halves.negative_upa[i]));
    });
    first += halves.positive_upa.size();
  }
  return phase;
}

}  // namespace

msg::AppliedSettings applied_settings(const MultibeamConfig& config, const PingEvent& event,
                                      const HeadSettings& settings, const Steering& steering) {
  msg::AppliedSettings applied;
  fill(applied, settings);
  if (!config.effects.tvg) applied.gain_spreading_db = applied.gain_absorption_dbpm = 0.0;
  applied.range_m = event.range_m;
  applied.frequency_hz = config.frequency_hz;
  fill_shape(config.chirp, config.tapered_fraction, applied);
  applied.bandwidth_hz = config.bandwidth_hz;
  applied.transmit_beamwidth_rad = config.transmit_beamwidth_rad;
  applied.receive_beamwidth_rad = config.receive_beamwidth_rad;
  applied.roll_stabilised = steering.roll_stabilised;
  applied.pitch_stabilised = steering.pitch_stabilised;
  applied.yaw_stabilised = steering.yaw_stabilised;
  applied.sound_speed_mps = steering.sound_speed_mps;
  // A single transmission that is straight needs no list; one that is steered against pitch has a tilt to state.
  const std::vector<MultibeamConfig::Sector> sectors = config.all_sectors();
  const bool straight = config.sectors.empty() && steering.sectors.front().sin_transmit == 0.0;
  for (std::size_t i = 0; i < sectors.size() && !straight; ++i) {
    msg::TransmitSector sector;
    sector.frequency_hz = sectors[i].frequency_hz;
    sector.pulse = applied.pulse;
    sector.pulse_length_s = settings.pulse_length_s;
    sector.bandwidth_hz = config.bandwidth_hz;
    sector.source_level_db = settings.source_level_db;
    sector.tilt_rad = std::asin(std::clamp(steering.sectors[i].sin_transmit, -1.0, 1.0));
    sector.delay_s = sectors[i].delay_s;
    applied.sectors.push_back(sector);
  }
  return applied;
}

msg::Ping ping_message(const MultibeamConfig& config, const PingEvent& event, const HeadSettings& settings,
                       const Steering& steering, const msg::AppliedSettings& applied, const PingImage& image) {
  msg::Ping ping;
  ping.stamp_ns = event.transmit.count();
  ping.ping = event.ping;
  ping.kind = "multibeam";
  ping.beam_angle_rad = msg::Array<float>::of(steering.beam_angle_rad);
  if (steering.sectors.size() > 1) ping.beam_sector = msg::Array<std::uint8_t>::of(steering.beam_sector);
  ping.applied = applied;
  const echo::Sampling sampling{0.0, 1.0 / config.sample_rate_hz,
                                config.samples(event.range_m, settings.pulse_length_s)};
  echo::TvgLaw gain = tvg_of(settings, steering.sound_speed_mps);
  gain.spreading_db = applied.gain_spreading_db;
  gain.absorption_dbpm = applied.gain_absorption_dbpm;
  write_samples(gain, config.converter_in_use(), sampling, image.amplitude_upa, ping);
  if (image.phase && config.effects.speckle) {
    const auto values = phase_rad(image);
    ping.phase_rad = msg::Array<float>::view({steering.sin_beams.size(), static_cast<std::size_t>(sampling.count)},
                                             values, values->data());
  }
  return ping;
}

}  // namespace ensonify
