#include "components/forward_looking/head.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/runtime/head/head_motion.h"
#include "kernels/array/beam_layout.h"
#include "kernels/array/line.h"
#include "kernels/array/near_field.h"
#include "kernels/echo/multipath.h"

namespace ensonify {
namespace {

constexpr double kNominalSpeed_mps = 1500.0;  // for which arrays are built
constexpr double kBeyondAperture_rad = 0.15;  // to where rays go, for the beams' side lobes
constexpr double kWidest_rad = 1.5;
constexpr double kCellsPerResolution = 2.0;  // of seabed that answers as one point
constexpr double kVolumeStep_rad = 0.5 * std::numbers::pi / 180.0;
constexpr double kInLobe = 0.1;  // -10 dB of the transmission

double power_of(double level_db) { return std::pow(10.0, 0.1 * level_db); }

array::LineArray array_of(const ForwardLookingConfig& config) {
  return array::line_array_of_width(config.beamwidth_rad, kNominalSpeed_mps / config.frequency_hz);
}

/// Where side lobes are switched off: Dolph-Chebyshev weights, which put them at -60 dB and widen the main lobe.
std::vector<float> weights_of(const array::LineArray& array, bool side_lobes) {
  if (side_lobes) return echo::beam_weights(array.weights);
  return echo::beam_weights(array::shading_weights({array::Shading::Window::kDolphChebyshev, 60.0}, array.elements()));
}

double true_speed_mps(const ForwardLookingConfig& config, const Environment& environment) {
  return environment.profile().speed_mps(config.world.mission.depth_m);
}

echo::ElementLine line_of(const ForwardLookingConfig& config, const array::LineArray& array,
                          const Environment& environment) {
  return echo::element_line(array, true_speed_mps(config, environment) / config.frequency_hz);
}

/// All elevations, with the main lobe of the narrower face; the aperture and what side lobes of its last beams hear.
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
      environment_(config.world, config.frequency_hz),
      array_(array_of(config)),
      faces_(config, array_.element_length_m * config.frequency_hz / true_speed_mps(config, environment_)),
      paths_(environment_.profile(), config.effects.refraction),
      ambient_(config.world.seed, stream_of(config, "noise")),
      electronic_(config.world.seed, stream_of(config, "electronic")),
      volume_(config.world.seed, stream_of(config, "volume")),
      beam_angle_rad_(array::equiangular_beams_rad(0.5 * config.aperture_rad, config.beams)),
      weights_(weights_of(array_, config.effects.side_lobes)),
      receiver_(line_of(config, array_, environment_)),
      power_receiver_(echo::power_line(receiver_.line())),
      noise_share_(faces_.noise_share()),
      images_(1),
      mean_square_(1) {
  if (config.effects.volume && !environment_.scattering_layers().empty()) {
    volume_directions_ = echo::directions_of_cells(
        receiver_,
        [this](const Eigen::Vector3f& direction) {
          const double heard = static_cast<double>(faces_.element_amplitude(direction));
          return faces_.transmitted_power(direction) * heard * heard;
        },
        kVolumeStep_rad);
  }
}

double ForwardLookingHead::near_field_m() const {
  return array::near_field_range_m(array_, kNominalSpeed_mps / config_.frequency_hz);
}

void ForwardLookingHead::prepare(double range_m) {
  const RangedPulse ranged = pulse_for(range_m);
  if (listening_ && listening_->ranged == ranged) return;
  const echo::Pulse pulse = echo_pulse(config_.pulse, ranged);
  const echo::SampledPulse sampled(pulse, ranged.sampling.period_s);
  const double resolution_m = 0.5 * kNominalSpeed_mps / ranged.band_hz;
  listening_.emplace(Listening{ranged, pulse, sampled, sampled.squared(),
                               echo::Scatterers(resolution_m / kCellsPerResolution, {config_.world.seed, "seabed"}),
                               trace::RayDistribution(volume_of(config_), {config_.quality, resolution_m},
                                                      {config_.world.seed, stream_of(config_, "rays")})});
}

msg::Ping ForwardLookingHead::listen(const Shot& shot, const HeadSettings& settings, double known_sound_speed_mps,
                                     const frames::PoseHistory& truth, const trace::Scene& seabed) {
  prepare(settings.range_m);
  const RangedPulse& ranged = listening_->ranged;
  head_poses(truth, config_.mounting.actual, shot.transmit, from_seconds(ranged.listening_s()), poses_);
  if (!config_.effects.motion) poses_.resize(1);
  receivers_.set({0.0, seconds(kTrackPeriod), poses_});
  look(seabed, settings.range_m);
  // What bubbles under the hull take on the way out and on the way back is the same for all paths.
  const double source_level_db = settings.source_level_db - 2.0 * environment_.bubble_loss_db();
  light(source_level_db);
  arrive(source_level_db);
  hear(shot, source_level_db, known_sound_speed_mps);

  msg::Ping ping;
  ping.stamp_ns = shot.transmit.count();
  ping.ping = shot.ping;
  ping.kind = "forward_looking";
  ping.beam_angle_rad = msg::Array<float>::of(beam_angle_rad_);
  const Converter converter = config_.effects.quantisation ? config_.converter : Converter{};
  write_samples(tvg_of(settings, known_sound_speed_mps), converter, ranged.sampling, images_[0], ping);
  fill(ping.applied, settings);
  ping.applied.frequency_hz = config_.frequency_hz;
  ping.applied.pulse = config_.pulse.chirp ? "fm_up" : "cw";
  ping.applied.pulse_length_s = ranged.length_s;
  ping.applied.bandwidth_hz = config_.pulse.chirp ? ranged.band_hz : 0.0;
  ping.applied.transmit_beamwidth_rad = config_.transmit_vertical_rad;
  ping.applied.receive_beamwidth_rad = config_.beamwidth_rad;
  ping.applied.sound_speed_mps = known_sound_speed_mps;
  return ping;
}

void ForwardLookingHead::look(const trace::Scene& seabed, double range_m) {
  const auto& sampling = listening_->ranged.sampling;
  // The window is set by the head's sound speed; sound travels by the true one.
  const double reach_m = 0.5 * paths_.sound_speed_mps(poses_.front()) * sampling.count * sampling.period_s;
  const frames::HeadPose& pose = poses_.front();
  paths_.trace(seabed, pose, listening_->rays.probes(), reach_m, hits_);
  listening_->rays.fill(pose, hits_, static_cast<float>(reach_m), rays_);
  paths_.trace(seabed, pose, rays_, reach_m, hits_);
  sight_ = {.range_m = range_m, .altitude_m = altitude_m(seabed, pose)};
}

/// What rays carry to what they met.
void ForwardLookingHead::light(double source_level_db) {
  const double source = power_of(source_level_db);
  source_upa2m2_.resize(rays_.size());
  backscatter_.resize(rays_.size());
  double height_m = 0.0;
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    if (!hits_[i].hit()) continue;
    const double transmitted = faces_.transmitted_power(rays_[i].direction_head);
    ++sight_.rays_that_hit;
    sight_.rays_in_lobe += transmitted > kInLobe ? 1 : 0;
    height_m += hits_[i].position_enu_m.z();
    source_upa2m2_[i] = static_cast<float>(source * transmitted);
    backscatter_[i] = environment_.backscatter()(hits_[i].sediment, hits_[i].sin_grazing);
  }
  const double head_depth_m = -poses_.front().position_enu_m.z();
  seabed_depth_m_ = sight_.rays_that_hit > 0 ? -height_m / sight_.rays_that_hit : head_depth_m;
  absorption_dbpm_ = config_.effects.absorption ? environment_.absorption_dbpm(head_depth_m, seabed_depth_m_) : 0.0;
}

void ForwardLookingHead::arrive(double source_level_db) {
  const frames::HeadPose& pose = poses_.front();
  const echo::Carrier carrier{config_.frequency_hz, absorption_dbpm_,
                              config_.effects.speckle ? echo::Sum::kPressure : echo::Sum::kMeanSquare};
  const auto scatterers = listening_->scatterers.find({pose, rays_, hits_, source_upa2m2_, backscatter_});
  arrivals_.clear();
  echo::add_direct_echoes(carrier, pose.position_enu_m, scatterers, receivers_, arrivals_);
  if (config_.effects.multipath) {
    echo::MultipathHead head;
    head.source_level_db = source_level_db;
    head.transmit = [this](const Eigen::Vector3f& direction) { return faces_.transmitted_power(direction); };
    echo::SurfaceMirror surface;
    surface.sound_speed_mps = paths_.sound_speed_mps(pose);
    surface.rms_height_m = environment_.rms_wave_height_m();
    echo::add_multipath(carrier, head, surface, {}, pose, scatterers, receivers_, arrivals_);
  }
  gain_.resize(arrivals_.size());
  for (std::size_t i = 0; i < arrivals_.size(); ++i) {
    const float amplitude = faces_.element_amplitude(arrivals_[i].direction_head);
    gain_[i] = config_.effects.speckle ? amplitude : amplitude * amplitude;
  }
}

void ForwardLookingHead::hear(const Shot& shot, double source_level_db, double known_sound_speed_mps) {
  // Delays are made for the sound speed that the head knows; the true one turns its beams.
  const double turned = paths_.sound_speed_mps(poses_.front()) / known_sound_speed_mps;
  sin_beams_.clear();
  for (const float angle : beam_angle_rad_) {
    sin_beams_.push_back(static_cast<float>(std::clamp(turned * std::sin(static_cast<double>(angle)), -1.0, 1.0)));
  }
  form_beams(background(shot, source_level_db));
}

echo::Background ForwardLookingHead::background(const Shot& shot, double source_level_db) {
  const echo::Pulse& pulse = listening_->pulse;
  echo::Background background;
  background.ping = static_cast<std::uint64_t>(shot.ping);
  if (config_.effects.noise) {
    background.isotropic_upa2 = power_of(environment_.noise_level_db()) * pulse.noise_bandwidth_hz * noise_share_;
    background.isotropic = &ambient_;
    background.electronic_upa2 = power_of(config_.electronic_noise_db) * pulse.noise_bandwidth_hz;
    background.electronic = &electronic_;
  }
  if (!volume_directions_.empty()) {
    echo::VolumeLayers layers;
    layers.backscatter_per_m = [this](double depth_m) {
      return power_of(water::volume_scattering_db(environment_.scattering_layers(), depth_m));
    };
    layers.deepest_m = seabed_depth_m_;
    echo::reverberation_upa2(source_level_db, absorption_dbpm_, paths_.sound_speed_mps(poses_.front()),
                             volume_directions_, layers, poses_.front(), pulse, listening_->ranged.sampling,
                             volume_upa2_);
    background.volume_upa2 = volume_upa2_;
    background.volume = &volume_;
  }
  return background;
}

/// Without speckle the seabed's mean-square pressure is summed apart, and its root stands in the background's field.
void ForwardLookingHead::form_beams(const echo::Background& background) {
  const echo::Sampling& sampling = listening_->ranged.sampling;
  const std::vector<std::vector<float>> weights{weights_};
  if (config_.effects.speckle) {
    receiver_.form({arrivals_, gain_, listening_->sampled, sampling, background}, sin_beams_, weights, images_);
    return;
  }
  const std::vector<std::vector<float>> power{echo::power_weights(weights_)};
  power_receiver_.form({arrivals_, gain_, listening_->squared, sampling, {}}, sin_beams_, power, mean_square_);
  receiver_.form({{}, {}, listening_->sampled, sampling, background}, sin_beams_, weights, images_);
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
