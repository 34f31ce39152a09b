#include "components/multibeam/sector.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "components/sonar/head_motion.h"
#include "kernels/acoustics/array/stabilisation.h"

namespace ensonify {
namespace {

constexpr double kReach = 8.0;  // sines in which rays are sent fore and aft, in lambda / L of a uniform line as wide
constexpr double kBeyondSwath_beamwidths = 1.5;  // of the outermost beam: to its first null and a little more
constexpr double kBeyondEdge = 0.8 * SectorPattern::kRollOff;  // sine
constexpr double kWidestFan_rad = 1.5;
constexpr std::size_t kFewestRays = 80'000;  // of all sectors, at normal quality: 20,000 of a preview
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

ReceiveArray array_of(const MultibeamConfig& config, const Effects& effects, const ArrayDesign& design,
                      std::size_t sector, const SectorPattern& pattern) {
  const double true_mps = true_profile(*config.world).speed_mps(config.world->mission.depth_m);
  ReceiveArray array;
  array.frequency_hz = design.sectors[sector].frequency_hz;
  array.elements = echo::element_line(design.receive.whole, true_mps / array.frequency_hz);
  array.weights = weights_of(design.receive, effects.speckle);
  array.element = pattern.element();
  array.noise_share = pattern.noise_share();
  array.electronic_noise_db = config.electronic_noise_db;
  array.seed = config.drawn_seed();
  array.process = config.process;
  array.suffix = suffix_of(sector);
  return array;
}

}  // namespace

Sector::Sector(const MultibeamConfig& config, const Effects& effects, const ArrayDesign& arrays, std::size_t number,
               std::shared_ptr<const Environment> environment)
    : config_(config),
      arrays_(arrays),
      number_(number),
      pattern_(config, arrays, number),
      echoes_(array_of(config, effects, arrays, number, pattern_), std::move(environment), effects, config.quality) {}

Sector::Design Sector::prepare(const HeadSettings& settings) const {
  const double resolution_m = range_resolution_m(config_, settings.pulse_length_s), swath_rad = settings.swath_rad;
  trace::RaySettings rays = config_.quality.ray_settings(resolution_m, config_.most_rays);
  rays.fewest_rays = std::min(kFewestRays / arrays_.sectors.size(),
                              static_cast<std::size_t>(0.5 * config_.most_rays / config_.quality.rays));
  // Steering moves the fan by a few degrees: the depths that it passes hardly change.
  array::Pattern unsteered;
  pattern_.steer(steer(config_, swath_rad, {}).sectors[number_], unsteered);
  const double reach = kReach / arrays_.sectors[number_].transmit_in_waves;
  const auto transmitted = [&](const Eigen::Vector3f& direction) {
    if (std::abs(static_cast<double>(direction.x())) > reach) return 0.0;
    return unsteered.power(direction);
  };
  return {sectors_of(config_, swath_rad)[number_].centre_rad,
          ShotDesign(config_.pulse(settings.pulse_length_s), 1.0 / config_.sample_rate_hz,
                     echo::SpeckleCells(echo::CellSize::for_beam(patch_m(resolution_m, config_.quality.rays),
                                                                 config_.transmit_beamwidth_rad),
                                        {config_.world->seed, "seabed", config_.drawn_seed()}),
                     trace::RayDistribution(volume_of(config_, arrays_, number_, swath_rad), rays,
                                            {config_.world->seed, config_.process + "/rays" + suffix_of(number_)})),
          echoes_.volume_directions(transmitted, kVolumeStep_beamwidths * config_.transmit_beamwidth_rad)};
}

Sector::Sent Sector::insonify(const PingEvent& event, const HeadSettings& settings, const Design& design,
                              const Steering& steering, const Surroundings& around, Memory& memory) const {
  const double delay_s = arrays_.sectors[number_].delay_s;
  const echo::Sampling sampling{-delay_s, 1.0 / config_.sample_rate_hz,
                                config_.samples(event.range_m, settings.pulse_length_s)};
  const double reception_s = config_.reception_s(event.range_m, settings.pulse_length_s) - delay_s;
  const SimTime sent = event.transmit + from_seconds(delay_s);
  head_poses(around.truth, config_.mounting.actual, sent, from_seconds(reception_s), memory.poses);
  aim(steering, memory.poses.front(), memory);
  pattern_.steer(memory.steered, memory.transmit);
  // Other sectors receive its echoes too, of a sweep earlier by up to a pulse.
  const Shot shot{.poses = memory.poses,
                  .transmit_s = seconds(sent),
                  .source_level_db = settings.source_level_db,
                  .transmit = {&memory.transmit, 1},
                  .steer = {memory.steered.sin_transmit, memory.steered.middle_rad - design.centre_rad},
                  .latest_s = latest_arrival_s(sampling, design.shot.pulse) + settings.pulse_length_s};
  // The window is set by the head's sound speed; sound travels by the true one.
  const double window_s =
      sampling.start_s + sampling.count * sampling.period_s - config_.resolved_s(settings.pulse_length_s);
  const SeaAcoustics& sea = echoes_.sea();
  const double reach_m = 0.5 * sea.sound_speed_mps(shot.pose()) * window_s;
  const trace::Mesh mesh = sea.mesh(shot, around.seabed, design.shot.rays, reach_m);
  return {shot, mesh, sea.insonify(shot, mesh, design.shot.rays, design.shot.cells, reach_m, memory.shot), sampling,
          design};
}

Echoed Sector::echoes(const Sent& sent, Memory& memory) const {
  return echoes_.sea().echoes(sent.shot, sent.insonified, memory.shot);
}

/// Of other sectors, which sent a little earlier or later, and of other heads.
const echo::Arrivals& Sector::foreign_echoes(const PingEvent& event, const HeadSettings& settings,
                                             std::span<const Sent> sent, std::span<const Echoed> echoed,
                                             Memory& memory) const {
  const Shot& shot = sent[number_].shot;
  const echo::Pulse& pulse = sent[number_].design.shot.pulse;
  const double delay_s = arrays_.sectors[number_].delay_s;
  echo::Arrivals& foreign = memory.shot.foreign;
  foreign.clear();
  for (std::size_t i = 0; i < sent.size(); ++i) {
    if (i == number_) continue;
    echo::InterferingTransmission other;
    other.time_s = arrays_.sectors[i].delay_s - delay_s;
    other.frequency_hz = arrays_.sectors[i].frequency_hz;
    other.sweep_hz = config_.chirp ? config_.bandwidth_hz : 0.0;
    other.duration_s = settings.pulse_length_s;
    other.rejection_db = config_.sector_rejection_db;
    echoes_.sea().add_echoes_of(shot, echoed[number_], other, echoed[i].arrivals, pulse, foreign);
  }
  std::vector<echo::InterferingTransmission> interfering = event.interfering;
  for (echo::InterferingTransmission& transmission : interfering) transmission.time_s -= delay_s;
  echoes_.sea().add_interference(shot, echoed[number_], interfering, pulse, foreign);
  return foreign;
}

SectorBeams Sector::beamform(const PingEvent& event, const HeadSettings& settings, std::span<const Sent> sent,
                             std::span<const Echoed> echoed, std::span<float> amplitude_upa, Memory& memory) const {
  const auto& [shot, mesh, insonified, sampling, design] = sent[number_];
  const echo::Pulse& pulse = design.shot.pulse;
  const echo::Arrivals& foreign = foreign_echoes(event, settings, sent, echoed, memory);
  const auto images = echoes_.beamform(
      shot, echoed[number_], design.shot,
      {event.number(), sampling, memory.sin_beams, design.volume_directions, foreign, amplitude_upa}, memory.beams);

  const double echo_s = pulse.equivalent_length_s(), middle_s = 0.5 * (pulse.start_s + pulse.end_s());
  const double start_s = sampling.start_s + (0.5 * echo_s - middle_s);
  detect::HalfApertures halves;
  if (images.size() == 3) halves = {images[1].envelope_upa, images[2].envelope_upa};
  return {{images.front().beams, images.front().samples, start_s, sampling.period_s, amplitude_upa},
          halves,
          echo_s,
          middle_s};
}

std::vector<SourceEnergy> Sector::energies(const PingEvent& event, const HeadSettings& settings,
                                           std::span<const Sent> sent, std::span<const Echoed> echoed,
                                           std::span<const float> sin_beams, Memory& memory) const {
  const Sent& own = sent[number_];
  const echo::Arrivals& foreign = foreign_echoes(event, settings, sent, echoed, memory);
  return echoes_.energies(own.shot, echoed[number_], own.design.shot,
                          {event.number(), own.sampling, sin_beams, own.design.volume_directions, foreign},
                          memory.beams);
}

/// A flat array's delays are made for the sound speed that the head assumes; the true one turns its beams.
void Sector::aim(const Steering& steering, const frames::HeadPose& pose, Memory& memory) const {
  const double true_mps = echoes_.sea().sound_speed_mps(pose);
  const auto true_sine = [&](double sine) { return array::true_sine(sine, steering.sound_speed_mps, true_mps); };
  SteeredSector& sector = memory.steered = steering.sectors[number_];
  sector.sin_transmit = true_sine(sector.sin_transmit);
  sector.lower_sine = true_sine(sector.lower_sine);
  sector.upper_sine = true_sine(sector.upper_sine);
  memory.sin_beams.clear();
  for (int beam = sector.first_beam; beam < sector.first_beam + sector.beams; ++beam) {
    const double sine = true_sine(static_cast<double>(steering.sin_beams[static_cast<std::size_t>(beam)]));
    memory.sin_beams.push_back(static_cast<float>(std::clamp(sine, -1.0, 1.0)));
  }
}

}  // namespace ensonify
