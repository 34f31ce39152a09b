#include "components/multibeam/head.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "components/sonar/tone_shape.h"

namespace ensonify {

MultibeamHead::MultibeamHead(const MultibeamConfig& config) : config_(config) {
  for (std::size_t sector = 0; sector < config.all_sectors().size(); ++sector) sectors_.emplace_back(config, sector);
}

const std::vector<MultibeamHead::Received>& MultibeamHead::receive_echoes(const PingEvent& event,
                                                                          const HeadSettings& settings,
                                                                          const Steering& steering,
                                                                          const frames::PoseHistory& truth,
                                                                          trace::Scene& seabed) {
  if (!amplitude_upa_ || amplitude_upa_.use_count() > 1) amplitude_upa_ = std::make_shared<std::vector<float>>();
  const auto samples = static_cast<std::size_t>(config_.samples(event.range_m, settings.pulse_length_s));
  amplitude_upa_->resize(samples * steering.sin_beams.size());
  received_.clear();
  for (SectorEchoes& sector : sectors_) sector.send(event, settings, steering, truth, seabed);
  for (std::size_t i = 0; i < sectors_.size(); ++i) {
    SectorEchoes& sector = sectors_[i];
    sector.beamform(event, settings, sectors_);
    const echo::Image& whole = sector.whole();
    const auto rows = std::span(*amplitude_upa_)
                          .subspan(samples * static_cast<std::size_t>(steering.sectors[i].first_beam),
                                   samples * static_cast<std::size_t>(steering.sectors[i].beams));
    if (sectors_.size() == 1) {
      echo::amplitude_upa(whole, *amplitude_upa_);
    } else {
      echo::amplitude_upa(whole, part_);
      std::ranges::copy(part_, rows.begin());
    }
    const echo::Pulse& pulse = sector.pulse();
    const double echo_s = pulse.equivalent_length_s(), middle_s = 0.5 * (pulse.start_s + pulse.end_s());
    const double start_s = sector.sampling().start_s + (0.5 * echo_s - middle_s);
    received_.push_back({{whole.beams, whole.samples, start_s, sector.sampling().period_s, rows},
                         {sector.starboard().envelope_upa, sector.port().envelope_upa},
                         echo_s,
                         middle_s});
  }
  return received_;
}

TraceSummary MultibeamHead::trace_summary(double range_m, const trace::Scene& seabed) const {
  TraceSummary all = sectors_.front().trace_summary(range_m, seabed);
  for (std::size_t i = 1; i < sectors_.size(); ++i) {
    const TraceSummary trace_summary = sectors_[i].trace_summary(range_m, seabed);
    all.rays_that_hit += trace_summary.rays_that_hit;
    all.rays_in_lobe += trace_summary.rays_in_lobe;
  }
  return all;
}

msg::Ping MultibeamHead::ping_message(const PingEvent& event, const HeadSettings& settings, const Steering& steering,
                                      bool phase) const {
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
  write_samples(gain, config_.converter_in_use(), sampling, amplitude_upa_, ping);
  if (phase && config_.effects.speckle) {
    const auto values = phase_rad();
    ping.phase_rad = msg::Array<float>::view({steering.sin_beams.size(), static_cast<std::size_t>(sampling.count)},
                                             values, values->data());
  }
  return ping;
}

std::shared_ptr<std::vector<float>> MultibeamHead::phase_rad() const {
  auto phase = std::make_shared<std::vector<float>>(amplitude_upa_->size());
  std::size_t first = 0;
  for (const Received& received : received_) {
    const auto& halves = received.halves;
    tbb::parallel_for(std::size_t{0}, halves.positive_upa.size(), [&](std::size_t i) {
      (*phase)[first + i] = std::arg(halves.positive_upa[i] * std::conj(halves.negative_upa[i]));
    });
    first += halves.positive_upa.size();
  }
  return phase;
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
