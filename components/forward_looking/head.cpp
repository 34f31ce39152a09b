#include "components/forward_looking/head.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/sonar/head_motion.h"
#include "components/sonar/patch.h"
#include "components/sonar/tone_shape.h"
#include "kernels/acoustics/array/beam_layout.h"
#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/array/near_field.h"

namespace ensonify {
namespace {

constexpr double kNominalSpeed_mps = 1500.0;  // for which arrays are built
constexpr double kBeyondAperture_rad = 0.15;  // to where rays go, for the beams' side lobes
constexpr double kWidest_rad = 1.5;
constexpr double kVolumeStep_rad = 0.5 * std::numbers::pi / 180.0;

double power_of(double level_db) { return std::pow(10.0, 0.1 * level_db); }

array::LineArray array_of(const ForwardLookingConfig& config) {
  return array::line_array_of_width(config.beamwidth_rad, kNominalSpeed_mps / config.frequency_hz, config.shading);
}

/// Where side lobes are switched off: Dolph-Chebyshev weights, which put them at -60 dB and widen the main lobe.
std::vector<float> weights_of(const array::LineArray& array, bool side_lobes) {
  if (side_lobes) return echo::beam_weights(array.weights);
  return echo::beam_weights(array::shading_weights({array::Shading::Window::kDolphChebyshev, 60.0}, array.elements()));
}

/// True, at the depth of the mission.
double wavelength_m(const ForwardLookingConfig& config) {
  return true_profile(config.world).speed_mps(config.world.mission.depth_m) / config.frequency_hz;
}

/// All elevations, with the main lobe of the narrower face; the aperture and what side lobes of its last beams receive.
trace::TransmitVolume volume_of(const ForwardLookingConfig& config) {
  const double tall = array::length_in_waves_for(std::min(config.transmit_vertical_rad, config.receive_vertical_rad));
  const double axis = std::sin(config.tilt_rad), half = 0.5 * config.aperture_rad;
  const double reach = std::min(kWidest_rad, half + kBeyondAperture_rad);
  trace::TransmitVolume volume;
  volume.axis = trace::TransmitVolume::Axis::kDown;
  volume.sine = {-1.0, 1.0, std::max(-1.0, axis - 1.0 / tall), std::min(1.0, axis + 1.0 / tall),
                 2.0 * array::half_power_half_width(tall)};
  volume.angle_rad = {-reach, reach, -half, half, config.beamwidth_rad};
  return volume;
}

std::string stream_of(const ForwardLookingConfig& config, const char* what) { return config.process + "/" + what; }

}  // namespace

ForwardLookingHead::ForwardLookingHead(const ForwardLookingConfig& config)
    : config_(config),
      array_(array_of(config)),
      faces_(config, array_.element_length_m / wavelength_m(config)),
      arrivals_(Environment(config.world, config.frequency_hz), config.frequency_hz, config.effects,
                [this](const Eigen::Vector3f& direction, float) { return faces_.transmitted_power(direction); }),
      ambient_(config.world.seed, stream_of(config, "noise")),
      electronic_(config.world.seed, stream_of(config, "electronic")),
      volume_(config.world.seed, stream_of(config, "volume")),
      beam_angle_rad_(array::equiangular_beams_rad(0.5 * config.aperture_rad, config.beams)),
      weights_(weights_of(array_, config.effects.side_lobes)),
      receiver_(echo::element_line(array_, wavelength_m(config))),
      noise_share_(faces_.noise_share()),
      images_(1),
      mean_square_(1) {
  if (!config.effects.speckle) power_receiver_.emplace(echo::power_line(receiver_.line()));
  if (arrivals_.water_scatters()) {
    volume_directions_ = echo::directions_of_cells(
        receiver_,
        [this](const Eigen::Vector3f& direction) {
          const double received = static_cast<double>(faces_.element_amplitude(direction));
          return faces_.transmitted_power(direction) * received * received;
        },
        kVolumeStep_rad);
  }
}

double ForwardLookingHead::near_field_m() const {
  return array::near_field_range_m(array_, kNominalSpeed_mps / config_.frequency_hz);
}

void ForwardLookingHead::prepare(const HeadSettings& settings) {
  const RangedPulse ranged = pulse_for(settings);
  if (design_ && design_->ranged == ranged) return;
  const echo::Pulse pulse = echo_pulse(config_.pulse, ranged);
  const echo::SampledPulse sampled(pulse, ranged.sampling.period_s);
  const double resolution_m = 0.5 * kNominalSpeed_mps / ranged.band_hz;
  design_.emplace(
      PingDesign{ranged, pulse, sampled, sampled.squared(),
                 echo::Scatterers(patch_m(0.5 * resolution_m, config_.quality), {config_.world.seed, "seabed"}),
                 trace::RayDistribution(volume_of(config_), {config_.quality, resolution_m},
                                        {config_.world.seed, stream_of(config_, "rays")})});
}

msg::Ping ForwardLookingHead::receive_echoes(const PingEvent& event, const HeadSettings& settings,
                                             double known_sound_speed_mps, const frames::PoseHistory& truth,
                                             trace::Scene& seabed) {
  prepare(settings);
  const RangedPulse& ranged = design_->ranged;
  head_poses(truth, config_.mounting.actual, event.transmit, from_seconds(ranged.reception_s()), poses_);
  arrivals_.move(poses_, seconds(event.transmit));
  insonify(seabed);
  point_beams(known_sound_speed_mps);
  arrivals_.receive_echoes(settings.source_level_db, design_->scatterers, rays_, hits_);
  const auto& arrivals = arrivals_.add_interference(event.interfering, design_->pulse);
  form_beams(arrivals, background(event, settings.source_level_db));
  trace_summary_ = arrivals_.trace_summary(settings.range_m, seabed);

  msg::Ping ping;
  ping.stamp_ns = event.transmit.count();
  ping.ping = event.ping;
  ping.kind = "forward_looking";
  ping.beam_angle_rad = msg::Array<float>::of(beam_angle_rad_);
  write_samples(tvg_of(settings, known_sound_speed_mps), config_.converter_in_use(), ranged.sampling, images_[0], ping);
  fill(ping.applied, settings);
  ping.applied.frequency_hz = config_.frequency_hz;
  fill_shape(config_.pulse.chirp, config_.pulse.tapered_fraction, ping.applied);
  ping.applied.pulse_length_s = ranged.length_s;
  ping.applied.bandwidth_hz = config_.pulse.chirp ? ranged.band_hz : 0.0;
  ping.applied.transmit_beamwidth_rad = config_.transmit_vertical_rad;
  ping.applied.receive_beamwidth_rad = config_.beamwidth_rad;
  ping.applied.sound_speed_mps = known_sound_speed_mps;
  return ping;
}

void ForwardLookingHead::insonify(trace::Scene& seabed) {
  const auto& sampling = design_->ranged.sampling;
  // The window is set by the head's sound speed; sound travels by the true one.
  const double reach_m = 0.5 * arrivals_.sound_speed_mps() * sampling.count * sampling.period_s;
  arrivals_.insonify(seabed, design_->rays, reach_m, rays_, hits_);
}

/// Delays are made for the sound speed that the head knows; the true one turns its beams.
void ForwardLookingHead::point_beams(double known_sound_speed_mps) {
  const double turned = arrivals_.sound_speed_mps() / known_sound_speed_mps;
  sin_beams_.clear();
  for (const float angle : beam_angle_rad_) {
    sin_beams_.push_back(static_cast<float>(std::clamp(turned * std::sin(static_cast<double>(angle)), -1.0, 1.0)));
  }
}

echo::Background ForwardLookingHead::background(const PingEvent& event, double source_level_db) {
  const echo::Pulse& pulse = design_->pulse;
  echo::Background background;
  background.ping = static_cast<std::uint64_t>(event.ping);
  if (config_.effects.noise) {
    background.isotropic_upa2 =
        power_of(arrivals_.environment().noise_level_db()) * pulse.noise_bandwidth_hz * noise_share_;
    background.isotropic = &ambient_;
    background.electronic_upa2 = power_of(config_.electronic_noise_db) * pulse.noise_bandwidth_hz;
    background.electronic = &electronic_;
  }
  if (arrivals_.water_scatters()) {
    background.volume_upa2 =
        arrivals_.reverberation_upa2(source_level_db, volume_directions_, pulse, design_->ranged.sampling);
    background.volume = &volume_;
  }
  return background;
}

/// Without speckle the seabed's mean-square pressure is summed apart, and its root stands in the background's field.
void ForwardLookingHead::form_beams(std::span<const echo::Arrival> arrivals, const echo::Background& background) {
  arrivals_.gains([this](const echo::Arrival& arrival) { return faces_.element_amplitude(arrival.direction_head); },
                  gain_);
  const echo::Sampling& sampling = design_->ranged.sampling;
  const std::vector<std::vector<float>> weights{weights_};
  if (config_.effects.speckle) {
    receiver_.form({arrivals, gain_, design_->sampled, sampling, background}, sin_beams_, weights, images_);
    return;
  }
  const std::vector<std::vector<float>> power{echo::power_weights(weights_)};
  power_receiver_->form({arrivals, gain_, design_->squared, sampling, {}}, sin_beams_, power, mean_square_);
  receiver_.form({{}, {}, design_->sampled, sampling, background}, sin_beams_, weights, images_);
  const auto& mean_square = mean_square_[0].envelope_upa;
  auto& envelope = images_[0].envelope_upa;
  for (std::size_t i = 0; i < envelope.size(); ++i) envelope[i] += std::sqrt(std::max(0.0F, mean_square[i].real()));
}

std::size_t ForwardLookingHead::max_ping_bytes() const {
  return static_cast<std::size_t>(config_.beams) * static_cast<std::size_t>(config_.pulse.most_samples) *
             sizeof(float) +
         65536;
}

}  // namespace ensonify
