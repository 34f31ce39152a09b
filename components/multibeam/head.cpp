#include "components/multibeam/head.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "components/sonar/ranged_pulse.h"

namespace ensonify {
namespace {

/// Of starboard over port, in the layout of the amplitudes.
std::shared_ptr<std::vector<float>> phase_rad(const MultibeamHead::Ping& ping) {
  auto phase = std::make_shared<std::vector<float>>(ping.amplitude_upa->size());
  std::size_t first = 0;
  for (const MultibeamHead::Received& received : ping.sectors) {
    const auto& halves = received.halves;
    tbb::parallel_for(std::size_t{0}, halves.positive_upa.size(), [&](std::size_t i) {
      (*phase)[first + i] = std::arg(halves.positive_upa[i] * std::conj(halves.negative_upa[i]));
    });
    first += halves.positive_upa.size();
  }
  return phase;
}

MultibeamHead::Received received_of(const SectorEchoes::Sent& sent, std::span<const echo::Image> images,
                                    std::span<const float> amplitude_upa) {
  const echo::Image& whole = images.front();
  const echo::Pulse& pulse = sent.design.array.pulse;
  const double echo_s = pulse.equivalent_length_s(), middle_s = 0.5 * (pulse.start_s + pulse.end_s());
  const double start_s = sent.sampling.start_s + (0.5 * echo_s - middle_s);
  detect::HalfApertures halves;
  if (images.size() == 3) halves = {images[1].envelope_upa, images[2].envelope_upa};
  return {{whole.beams, whole.samples, start_s, sent.sampling.period_s, amplitude_upa}, halves, echo_s, middle_s};
}

}  // namespace

MultibeamHead::MultibeamHead(const MultibeamConfig& config) : config_(config), design_(config) {
  for (std::size_t i = 0; i < design_.sectors.size(); ++i) sectors_.emplace_back(config, design_, i);
}

void MultibeamHead::receive_echoes(const PingEvent& event, const HeadSettings& settings, const Steering& steering,
                                   const frames::PoseHistory& truth, trace::Scene& seabed, Ping& ping) {
  if (!ping.amplitude_upa || ping.amplitude_upa.use_count() > 1)
    ping.amplitude_upa = std::make_shared<std::vector<float>>();
  const auto samples = static_cast<std::size_t>(config_.samples(event.range_m, settings.pulse_length_s));
  ping.amplitude_upa->resize(samples * steering.sin_beams.size());
  ping.memory.resize(sectors_.size());
  ping.sent.clear();
  ping.sectors.clear();
  const auto fits = [&](const SectorEchoes::PingDesign& design) {
    return design.pulse_length_s == settings.pulse_length_s && design.swath_rad == settings.swath_rad;
  };
  if (designs_.empty() || !fits(designs_.front())) {
    designs_.clear();
    for (const SectorEchoes& sector : sectors_)
      designs_.push_back(sector.design_for(settings.pulse_length_s, settings.swath_rad));
  }
  for (std::size_t i = 0; i < sectors_.size(); ++i) {
    ping.sent.push_back(sectors_[i].send(event, settings, designs_[i], steering, truth, seabed, ping.memory[i]));
  }
  for (std::size_t i = 0; i < sectors_.size(); ++i) {
    sectors_[i].beamform(event, settings, ping.sent, ping.memory[i]);
    const auto& images = ping.memory[i].beams.images;
    const auto rows = std::span(*ping.amplitude_upa)
                          .subspan(samples * static_cast<std::size_t>(steering.sectors[i].first_beam),
                                   samples * static_cast<std::size_t>(steering.sectors[i].beams));
    if (sectors_.size() == 1) {
      echo::amplitude_upa(images.front(), *ping.amplitude_upa);
    } else {
      echo::amplitude_upa(images.front(), ping.part);
      std::ranges::copy(ping.part, rows.begin());
    }
    ping.sectors.push_back(received_of(ping.sent[i], images, rows));
  }
  ping.trace = ping.sent.front().echoed.summary(ping.sent.front().shot, event.range_m, seabed);
  for (const SectorEchoes::Sent& sent : std::span(ping.sent).subspan(1)) {
    ping.trace.rays_that_hit += sent.echoed.rays_that_hit;
    ping.trace.rays_in_lobe += sent.echoed.rays_in_lobe;
  }
}

msg::Ping MultibeamHead::ping_message(const Ping& received, const PingEvent& event, const HeadSettings& settings,
                                      const Steering& steering, bool phase) const {
  msg::Ping ping;
  ping.stamp_ns = event.transmit.count();
  ping.ping = event.ping;
  ping.kind = "multibeam";
  ping.beam_angle_rad = msg::Array<float>::of(steering.beam_angle_rad);
  if (steering.sectors.size() > 1) ping.beam_sector = msg::Array<std::uint8_t>::of(steering.beam_sector);
  ping.applied = applied(event, settings, steering);
  const echo::Sampling sampling{0.0, 1.0 / config_.sample_rate_hz,
                                config_.samples(event.range_m, settings.pulse_length_s)};
  echo::TvgLaw gain = tvg_of(settings, steering.sound_speed_mps);
  gain.spreading_db = ping.applied.gain_spreading_db;
  gain.absorption_dbpm = ping.applied.gain_absorption_dbpm;
  write_samples(gain, config_.converter_in_use(), sampling, received.amplitude_upa, ping);
  if (phase && config_.effects.speckle) {
    const auto values = phase_rad(received);
    ping.phase_rad = msg::Array<float>::view({steering.sin_beams.size(), static_cast<std::size_t>(sampling.count)},
                                             values, values->data());
  }
  return ping;
}

msg::AppliedSettings MultibeamHead::applied(const PingEvent& event, const HeadSettings& settings,
                                            const Steering& steering) const {
  msg::AppliedSettings applied;
  fill(applied, settings);
  if (!config_.effects.tvg) applied.gain_spreading_db = applied.gain_absorption_dbpm = 0.0;
  applied.range_m = event.range_m;
  applied.frequency_hz = config_.frequency_hz;
  fill_shape(config_.chirp, config_.tapered_fraction, applied);
  applied.bandwidth_hz = config_.bandwidth_hz;
  applied.transmit_beamwidth_rad = config_.transmit_beamwidth_rad;
  applied.receive_beamwidth_rad = config_.receive_beamwidth_rad;
  applied.roll_stabilised = steering.roll_stabilised;
  applied.pitch_stabilised = steering.pitch_stabilised;
  applied.yaw_stabilised = steering.yaw_stabilised;
  applied.sound_speed_mps = steering.sound_speed_mps;
  for (std::size_t i = 0; i < config_.sectors.size(); ++i) {
    msg::TransmitSector sector;
    sector.frequency_hz = config_.sectors[i].frequency_hz;
    sector.pulse = applied.pulse;
    sector.pulse_length_s = settings.pulse_length_s;
    sector.bandwidth_hz = config_.bandwidth_hz;
    sector.source_level_db = settings.source_level_db;
    sector.tilt_rad = std::asin(std::clamp(steering.sectors[i].sin_transmit, -1.0, 1.0));
    sector.delay_s = config_.sectors[i].delay_s;
    applied.sectors.push_back(sector);
  }
  return applied;
}

std::size_t MultibeamHead::max_ping_bytes() const {
  return static_cast<std::size_t>(config_.beams) * static_cast<std::size_t>(config_.most_samples() + 1) * 2 *
             sizeof(float) +
         65536;
}

}  // namespace ensonify
