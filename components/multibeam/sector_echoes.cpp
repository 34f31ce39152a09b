#include "components/multibeam/sector_echoes.h"

#include <algorithm>
#include <cmath>

#include "components/sonar/head_motion.h"
#include "components/sonar/patch.h"
#include "kernels/acoustics/array/stabilisation.h"

namespace ensonify {
namespace {

constexpr double kReach = 8.0;  // sines in which rays are sent fore and aft, in lambda / L of a uniform line as wide
constexpr double kBeyondSwath_beamwidths = 1.5;  // of the outermost beam: to its first null and a little more
constexpr double kBeyondEdge = 0.8 * SectorPattern::kRollOff;  // sine
constexpr double kWidestFan_rad = 1.5;
constexpr std::size_t kFewestRays = 80'000;  // of all sectors, at normal quality: 20,000 at the default
constexpr double kVolumeStep_beamwidths = 0.25;

double power_of(double level_db) { return std::pow(10.0, 0.1 * level_db); }

double range_resolution_m(const MultibeamConfig& c, double pulse_length_s) {
  return 0.5 * c.sound_speed_mps * c.resolved_s(pulse_length_s);
}

/// The first sector's names are those of a head without sectors.
std::string stream_of(const MultibeamConfig& config, std::size_t sector, const std::string& what) {
  return config.process + "/" + what + (sector == 0 ? "" : "/" + std::to_string(sector));
}

/// The sector's part of the swath and what its outer beams receive beside it, when nothing is steered.
trace::TransmitVolume volume_of(const MultibeamConfig& c, std::size_t number, double swath_rad) {
  const auto sectors = sectors_of(c, swath_rad);
  const array::TransmitSector& sector = sectors[number];
  const double half = 0.5 * swath_rad;
  const double reach =
      std::min(kWidestFan_rad, half + kBeyondSwath_beamwidths * c.receive_beamwidth_rad / std::cos(half));
  auto volume = trace::mills_cross_volume(transmit_length_in_waves(c, sector.frequency_hz),
                                          receive_length_in_waves(c, sector.frequency_hz), reach, kReach);
  const double null = std::min(volume.sine.high, transmit_null(c, sector.frequency_hz));
  volume.sine.main_low = -null, volume.sine.main_high = null;
  const auto beyond = [&](double edge_rad, double sine) {
    return std::asin(std::clamp(std::sin(edge_rad) + sine, -std::sin(reach), std::sin(reach)));
  };
  trace::Span& angle = volume.angle_rad;
  if (number > 0) angle.low = angle.main_low = beyond(sector.lower_rad(), -kBeyondEdge);
  if (number + 1 < sectors.size()) angle.high = angle.main_high = beyond(sector.upper_rad(), kBeyondEdge);
  return volume;
}

std::vector<std::vector<float>> weights_of(const ReceiveLine& line, bool halves) {
  std::vector<std::vector<float>> weights{echo::beam_weights(line.whole.weights)};
  if (!halves) return weights;
  weights.push_back(echo::beam_weights(line.halves.positive, line.whole.weights));
  weights.push_back(echo::beam_weights(line.halves.negative, line.whole.weights));
  return weights;
}

echo::ElementLine elements_of(const MultibeamConfig& config, double frequency_hz) {
  const double true_mps = true_profile(config.world).speed_mps(config.world.mission.depth_m);
  return echo::element_line(receive_line(config).whole, true_mps / frequency_hz);
}

}  // namespace

SectorEchoes::SectorEchoes(const MultibeamConfig& config, std::size_t sector)
    : config_(config),
      sector_(sector),
      frequency_hz_(config.all_sectors()[sector].frequency_hz),
      delay_s_(config.all_sectors()[sector].delay_s),
      pattern_(config, frequency_hz_),
      arrivals_(Environment(config.world, frequency_hz_), frequency_hz_, config.effects,
                [this](const Eigen::Vector3f& direction, float) {
                  return static_cast<double>(pattern_.transmitted_power(direction));
                }),
      ambient_(config.world.seed, stream_of(config, sector, "noise")),
      electronic_(config.world.seed, stream_of(config, sector, "electronic")),
      volume_(config.world.seed, stream_of(config, sector, "volume")),
      receiver_(elements_of(config, frequency_hz_)),
      weights_(weights_of(receive_line(config), config.effects.speckle)),
      power_weights_{echo::power_weights(weights_[0])},
      images_(3),
      mean_square_(1) {
  if (!config.effects.speckle) power_receiver_.emplace(echo::power_line(receiver_.line()));
}

SectorEchoes::PingDesign SectorEchoes::design_for(double pulse_length_s, double swath_rad) {
  const double resolution_m = range_resolution_m(config_, pulse_length_s);
  const echo::Pulse pulse = config_.pulse(pulse_length_s);
  const echo::SampledPulse sampled(pulse, 1.0 / config_.sample_rate_hz);
  std::vector<echo::VolumeDirections> directions;
  if (arrivals_.water_scatters()) {
    // Steering moves the fan by a few degrees: the depths that it passes hardly change.
    pattern_.steer(steer(config_, swath_rad, {}).sectors[sector_]);
    const double reach = kReach / transmit_length_in_waves(config_, frequency_hz_);
    directions = echo::directions_of_cells(
        receiver_,
        [&](const Eigen::Vector3f& direction) {
          if (std::abs(static_cast<double>(direction.x())) > reach) return 0.0;
          const double received = static_cast<double>(pattern_.element_amplitude(direction));
          return static_cast<double>(pattern_.transmitted_power(direction)) * received * received;
        },
        kVolumeStep_beamwidths * config_.transmit_beamwidth_rad);
  }
  const trace::RaySettings rays{.quality = config_.quality,
                                .range_resolution_m = resolution_m,
                                .fewest_rays = kFewestRays / config_.all_sectors().size()};
  return {pulse_length_s,
          swath_rad,
          sectors_of(config_, swath_rad)[sector_].centre_rad,
          pulse,
          sampled,
          sampled.squared(),
          echo::Scatterers(patch_m(resolution_m, config_.quality), {config_.world.seed, "seabed"}),
          trace::RayDistribution(volume_of(config_, sector_, swath_rad), rays,
                                 {config_.world.seed, stream_of(config_, sector_, "rays")}),
          std::move(directions)};
}

void SectorEchoes::send(const PingEvent& event, const HeadSettings& settings, const Steering& steering,
                        const frames::PoseHistory& truth, trace::Scene& seabed) {
  prepare(event, settings, truth);
  aim(steering);
  insonify(seabed);
  arrivals_.receive_echoes(settings.source_level_db, design_->scatterers, rays_, hits_);
}

void SectorEchoes::beamform(const PingEvent& event, const HeadSettings& settings, const std::deque<SectorEchoes>& all) {
  for (const SectorEchoes& other : all) {
    if (&other == this) continue;
    echo::InterferingTransmission sent;
    sent.time_s = other.delay_s_ - delay_s_;
    sent.frequency_hz = other.frequency_hz_;
    sent.sweep_hz = config_.chirp ? config_.bandwidth_hz : 0.0;
    sent.duration_s = settings.pulse_length_s;
    sent.rejection_db = config_.sector_rejection_db;
    arrivals_.add_echoes_of(sent, other.arrivals_.echoes(), design_->pulse);
  }
  std::vector<echo::InterferingTransmission> interfering = event.interfering;
  for (echo::InterferingTransmission& transmission : interfering) transmission.time_s -= delay_s_;
  const auto& arrivals = arrivals_.add_interference(interfering, design_->pulse);
  form_beams(arrivals, background(event.ping, settings.source_level_db));
}

void SectorEchoes::prepare(const PingEvent& event, const HeadSettings& settings, const frames::PoseHistory& truth) {
  if (!design_ || design_->pulse_length_s != settings.pulse_length_s || design_->swath_rad != settings.swath_rad) {
    design_.emplace(design_for(settings.pulse_length_s, settings.swath_rad));
  }
  sampling_ = {-delay_s_, 1.0 / config_.sample_rate_hz, config_.samples(event.range_m, settings.pulse_length_s)};
  const double reception_s = config_.reception_s(event.range_m, settings.pulse_length_s) - delay_s_;
  const SimTime sent = event.transmit + from_seconds(delay_s_);
  head_poses(truth, config_.mounting.actual, sent, from_seconds(reception_s), poses_);
  arrivals_.move(poses_, seconds(sent));
}

/// A flat array's delays are made for the sound speed that the head assumes; the true one turns its beams.
void SectorEchoes::aim(const Steering& steering) {
  const double true_mps = arrivals_.sound_speed_mps();
  const auto true_sine = [&](double sine) { return array::true_sine(sine, steering.sound_speed_mps, true_mps); };
  SteeredSector sector = steering.sectors[sector_];
  sector.sin_transmit = true_sine(sector.sin_transmit);
  sector.lower_sine = true_sine(sector.lower_sine);
  sector.upper_sine = true_sine(sector.upper_sine);
  pattern_.steer(sector);
  design_->rays.steer(sector.sin_transmit, sector.middle_rad - design_->centre_rad);
  sin_beams_.clear();
  for (int beam = sector.first_beam; beam < sector.first_beam + sector.beams; ++beam) {
    const double sine = true_sine(static_cast<double>(steering.sin_beams[static_cast<std::size_t>(beam)]));
    sin_beams_.push_back(static_cast<float>(std::clamp(sine, -1.0, 1.0)));
  }
}

void SectorEchoes::insonify(trace::Scene& seabed) {
  // The window is set by the head's sound speed; sound travels by the true one.
  const double window_s =
      sampling_.start_s + sampling_.count * sampling_.period_s - config_.resolved_s(design_->pulse_length_s);
  const double reach_m = 0.5 * arrivals_.sound_speed_mps() * window_s;
  arrivals_.insonify(seabed, design_->rays, reach_m, rays_, hits_);
}

echo::Background SectorEchoes::background(std::int64_t ping, double source_level_db) {
  const echo::Pulse& pulse = design_->pulse;
  echo::Background background;
  background.ping = static_cast<std::uint64_t>(ping);
  if (config_.effects.noise) {
    background.isotropic_upa2 =
        power_of(arrivals_.environment().noise_level_db()) * pulse.noise_bandwidth_hz * pattern_.noise_share();
    background.isotropic = &ambient_;
    background.electronic_upa2 = power_of(config_.electronic_noise_db) * pulse.noise_bandwidth_hz;
    background.electronic = &electronic_;
  }
  if (arrivals_.water_scatters()) {
    background.volume_upa2 =
        arrivals_.reverberation_upa2(source_level_db, design_->volume_directions, pulse, sampling_);
    background.volume = &volume_;
  }
  return background;
}

/// Without speckle the seabed's mean-square pressure is summed apart, and its root stands in the background's field.
void SectorEchoes::form_beams(std::span<const echo::Arrival> arrivals, const echo::Background& background) {
  arrivals_.gains([this](const echo::Arrival& arrival) { return pattern_.element_amplitude(arrival.direction_head); },
                  gain_);
  if (config_.effects.speckle) {
    receiver_.form({arrivals, gain_, design_->sampled, sampling_, background}, sin_beams_, weights_, images_);
    return;
  }
  const std::span whole(images_.data(), 1);
  power_receiver_->form({arrivals, gain_, design_->squared, sampling_, {}}, sin_beams_, power_weights_, mean_square_);
  receiver_.form({{}, {}, design_->sampled, sampling_, background}, sin_beams_, weights_, whole);
  const auto& mean_square = mean_square_[0].envelope_upa;
  auto& envelope = images_[0].envelope_upa;
  for (std::size_t i = 0; i < envelope.size(); ++i) envelope[i] += std::sqrt(std::max(0.0F, mean_square[i].real()));
}

}  // namespace ensonify
