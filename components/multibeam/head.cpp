#include "components/multibeam/head.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "components/sonar/head_motion.h"
#include "components/sonar/ranged_pulse.h"
#include "kernels/acoustics/array/stabilisation.h"

namespace ensonify {
namespace {

constexpr double kReach = 8.0;  // sines in which rays are sent fore and aft, in lambda / L of a uniform line as wide
constexpr double kBeyondSwath_beamwidths = 1.5;  // of the outermost beam: to its first null and a little more
constexpr double kBeyondEdge = 0.8 * SectorPattern::kRollOff;  // sine
constexpr double kWidestFan_rad = 1.5;
constexpr std::size_t kFewestRays = 80'000;  // of all sectors, at normal quality: 20,000 at the default
constexpr double kVolumeStep_beamwidths = 0.25;

double range_resolution_m(const MultibeamConfig& c, double pulse_length_s) {
  return 0.5 * c.sound_speed_mps * c.resolved_s(pulse_length_s);
}

/// Of names of streams: the first sector's are those of a head without sectors.
std::string suffix_of(std::size_t sector) { return sector == 0 ? "" : "/" + std::to_string(sector); }

/// The sector's part of the swath and what its outer beams receive beside it, when nothing is steered.
trace::TransmitVolume volume_of(const MultibeamConfig& c, const ArrayDesign& design, std::size_t number,
                                double swath_rad) {
  const auto sectors = sectors_of(c, swath_rad);
  const array::TransmitSector& sector = sectors[number];
  const SectorDesign& lines = design.sectors[number];
  const double half = 0.5 * swath_rad;
  const double reach =
      std::min(kWidestFan_rad, half + kBeyondSwath_beamwidths * c.receive_beamwidth_rad / std::cos(half));
  auto volume = trace::mills_cross_volume(lines.transmit_in_waves, lines.receive_in_waves, reach, kReach);
  const double null = std::min(volume.sine.high, lines.transmit_null);
  volume.sine.main_low = -null, volume.sine.main_high = null;
  const auto beyond = [&](double edge_rad, double sine) {
    return std::asin(std::clamp(std::sin(edge_rad) + sine, -std::sin(reach), std::sin(reach)));
  };
  trace::Span& angle = volume.angle_rad;
  if (number > 0) angle.low = angle.main_low = beyond(sector.lower_rad(), -kBeyondEdge);
  if (number + 1 < sectors.size()) angle.high = angle.main_high = beyond(sector.upper_rad(), kBeyondEdge);
  return volume;
}

/// The whole line, and its halves where sums have a phase.
std::vector<std::vector<float>> weights_of(const ReceiveLine& line, bool halves) {
  std::vector<std::vector<float>> weights{echo::beam_weights(line.whole.weights)};
  if (!halves) return weights;
  weights.push_back(echo::beam_weights(line.halves.positive, line.whole.weights));
  weights.push_back(echo::beam_weights(line.halves.negative, line.whole.weights));
  return weights;
}

ReceiveArray array_of(const MultibeamConfig& config, const ArrayDesign& design, std::size_t sector,
                      const SectorPattern& pattern) {
  const double true_mps = true_profile(*config.world).speed_mps(config.world->mission.depth_m);
  ReceiveArray array;
  array.frequency_hz = design.sectors[sector].frequency_hz;
  array.elements = echo::element_line(design.receive.whole, true_mps / array.frequency_hz);
  array.weights = weights_of(design.receive, config.effects.speckle);
  array.element = pattern.element();
  array.noise_share = pattern.noise_share();
  array.electronic_noise_db = config.electronic_noise_db;
  array.seed = config.world->seed;
  array.process = config.process;
  array.suffix = suffix_of(sector);
  return array;
}

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

SectorEchoes::SectorEchoes(const MultibeamConfig& config, const ArrayDesign& design, std::size_t sector,
                           std::shared_ptr<const Environment> environment)
    : config_(config),
      arrays_(design),
      sector_(sector),
      pattern_(config, design, sector),
      echoes_(array_of(config, design, sector, pattern_), std::move(environment), config.effects, config.quality) {}

SectorEchoes::PingDesign SectorEchoes::design_for(double pulse_length_s, double swath_rad) const {
  const double resolution_m = range_resolution_m(config_, pulse_length_s);
  trace::RaySettings rays = config_.quality.ray_settings(resolution_m);
  rays.fewest_rays = kFewestRays / arrays_.sectors.size();
  // Steering moves the fan by a few degrees: the depths that it passes hardly change.
  array::Pattern unsteered;
  pattern_.steer(steer(config_, swath_rad, {}).sectors[sector_], unsteered);
  const double reach = kReach / arrays_.sectors[sector_].transmit_in_waves;
  const auto transmitted = [&](const Eigen::Vector3f& direction) {
    if (std::abs(static_cast<double>(direction.x())) > reach) return 0.0;
    return unsteered.power(direction);
  };
  return {pulse_length_s, swath_rad, sectors_of(config_, swath_rad)[sector_].centre_rad,
          ArrayPulse(config_.pulse(pulse_length_s), 1.0 / config_.sample_rate_hz,
                     echo::SpeckleCells(patch_m(resolution_m, config_.quality.rays), {config_.world->seed, "seabed"}),
                     trace::RayDistribution(volume_of(config_, arrays_, sector_, swath_rad), rays,
                                            {config_.world->seed, config_.process + "/rays" + suffix_of(sector_)})),
          echoes_.volume_directions(transmitted, kVolumeStep_beamwidths * config_.transmit_beamwidth_rad)};
}

SectorEchoes::Sent SectorEchoes::send(const PingEvent& event, const HeadSettings& settings, const PingDesign& design,
                                      const Steering& steering, const frames::PoseHistory& truth,
                                      const trace::Scene& seabed, Memory& memory) const {
  const double delay_s = arrays_.sectors[sector_].delay_s;
  const echo::Sampling sampling{-delay_s, 1.0 / config_.sample_rate_hz,
                                config_.samples(event.range_m, settings.pulse_length_s)};
  const double reception_s = config_.reception_s(event.range_m, settings.pulse_length_s) - delay_s;
  const SimTime sent = event.transmit + from_seconds(delay_s);
  head_poses(truth, config_.mounting.actual, sent, from_seconds(reception_s), memory.poses);
  aim(steering, memory.poses.front(), memory);
  pattern_.steer(memory.steered, memory.transmit);
  const Shot shot{memory.poses,
                  seconds(sent),
                  settings.source_level_db,
                  {&memory.transmit, 1},
                  {memory.steered.sin_transmit, memory.steered.middle_rad - design.centre_rad}};
  // The window is set by the head's sound speed; sound travels by the true one.
  const double window_s =
      sampling.start_s + sampling.count * sampling.period_s - config_.resolved_s(settings.pulse_length_s);
  const double reach_m = 0.5 * echoes_.sea().sound_speed_mps(shot.pose()) * window_s;
  const trace::Mesh mesh = echoes_.sea().mesh(shot, seabed, design.array.rays, reach_m);
  const Insonified insonified =
      echoes_.sea().insonify(shot, mesh, design.array.rays, design.array.cells, reach_m, memory.shot);
  return {shot, echoes_.sea().echoes(shot, insonified, memory.shot), sampling, design};
}

void SectorEchoes::beamform(const PingEvent& event, const HeadSettings& settings, std::span<const Sent> all,
                            Memory& memory) const {
  const Sent& own = all[sector_];
  const double delay_s = arrays_.sectors[sector_].delay_s;
  memory.foreign.clear();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i == sector_) continue;
    echo::InterferingTransmission sent;
    sent.time_s = arrays_.sectors[i].delay_s - delay_s;
    sent.frequency_hz = arrays_.sectors[i].frequency_hz;
    sent.sweep_hz = config_.chirp ? config_.bandwidth_hz : 0.0;
    sent.duration_s = settings.pulse_length_s;
    sent.rejection_db = config_.sector_rejection_db;
    echoes_.sea().add_echoes_of(own.shot, own.echoed, sent, all[i].echoed.arrivals, own.design.array.pulse,
                                memory.foreign);
  }
  std::vector<echo::InterferingTransmission> interfering = event.interfering;
  for (echo::InterferingTransmission& transmission : interfering) transmission.time_s -= delay_s;
  echoes_.sea().add_interference(own.shot, own.echoed, interfering, own.design.array.pulse, memory.foreign);
  echoes_.beamform(own.shot, own.echoed, own.design.array,
                   {static_cast<std::uint64_t>(event.ping), own.sampling, memory.sin_beams,
                    own.design.volume_directions, memory.foreign},
                   memory.beams);
}

/// A flat array's delays are made for the sound speed that the head assumes; the true one turns its beams.
void SectorEchoes::aim(const Steering& steering, const frames::HeadPose& pose, Memory& memory) const {
  const double true_mps = echoes_.sea().sound_speed_mps(pose);
  const auto true_sine = [&](double sine) { return array::true_sine(sine, steering.sound_speed_mps, true_mps); };
  SteeredSector& sector = memory.steered = steering.sectors[sector_];
  sector.sin_transmit = true_sine(sector.sin_transmit);
  sector.lower_sine = true_sine(sector.lower_sine);
  sector.upper_sine = true_sine(sector.upper_sine);
  memory.sin_beams.clear();
  for (int beam = sector.first_beam; beam < sector.first_beam + sector.beams; ++beam) {
    const double sine = true_sine(static_cast<double>(steering.sin_beams[static_cast<std::size_t>(beam)]));
    memory.sin_beams.push_back(static_cast<float>(std::clamp(sine, -1.0, 1.0)));
  }
}

MultibeamHead::MultibeamHead(const MultibeamConfig& config) : config_(config), design_(config) {
  std::map<double, std::shared_ptr<const Environment>> environments;  // by frequency
  for (std::size_t i = 0; i < design_.sectors.size(); ++i) {
    auto& environment = environments[design_.sectors[i].frequency_hz];
    if (!environment) {
      environment = std::make_shared<const Environment>(*config.world, design_.sectors[i].frequency_hz);
    }
    sectors_.emplace_back(config, design_, i, environment);
  }
}

void MultibeamHead::receive_echoes(const PingEvent& event, const HeadSettings& settings, const Steering& steering,
                                   const frames::PoseHistory& truth, const trace::Scene& seabed, Ping& ping) {
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
