#include "components/multibeam/head.h"

#include <algorithm>
#include <cmath>

#include "kernels/array/line.h"
#include "kernels/array/line_array.h"
#include "kernels/seabed/lambert.h"
#include "kernels/water/noise.h"

namespace ensonify {
namespace {

constexpr int kRaysAlong = 20;
constexpr double kBeyondSwath_beamwidths = 1.5;  // of the outermost beam: to its first null and a little more
constexpr double kWidestFan_rad = 1.5;
constexpr SimTime kTrackPeriod = std::chrono::milliseconds(5);

trace::FanShape fan_of(const MultibeamConfig& c) {
  const double half = 0.5 * c.swath_rad;
  trace::FanShape shape;
  shape.transmit_length_in_waves = array::length_in_waves_for(c.transmit_beamwidth_rad);
  shape.half_swath_rad =
      std::min(kWidestFan_rad, half + kBeyondSwath_beamwidths * c.receive_beamwidth_rad / std::cos(half));
  shape.along = kRaysAlong;
  shape.across = (c.rays_per_ping + kRaysAlong - 1) / kRaysAlong;
  return shape;
}

std::vector<float> beams_of(const MultibeamConfig& c) {
  return c.spacing == MultibeamConfig::Spacing::kEquiangle ? array::equiangular_beams_rad(0.5 * c.swath_rad, c.beams)
                                                           : array::equidistant_beams_rad(0.5 * c.swath_rad, c.beams);
}

/// Isotropic noise in the pulse's band: at one element, and against the whole line, DI = 10 log10(2 L / lambda)
/// [Lurton2010, ch. 5].
double element_noise_db_of(const MultibeamConfig& c) {
  return water::in_band_level_db(c.noise_level_db, 1.0 / c.pulse_length_s, 0.0);
}
double beam_noise_db_of(const MultibeamConfig& c) {
  return element_noise_db_of(c) - 10.0 * std::log10(2.0 * array::length_in_waves_for(c.receive_beamwidth_rad));
}

double wavelength_m_of(const MultibeamConfig& c) { return c.sound_speed_mps / c.frequency_hz; }

array::LineArray receive_array_of(const MultibeamConfig& c) {
  return array::line_array_of_width(c.receive_beamwidth_rad, wavelength_m_of(c));
}

/// The range resolution, c tau / 2: finer cells would have too few rays each to be found again by the next ping.
double cell_m_of(const MultibeamConfig& c) { return 0.5 * c.sound_speed_mps * c.pulse_length_s; }

frames::HeadPose true_pose(const frames::PoseHistory& truth, SimTime t, const frames::Mounting& mounting) {
  const auto body = truth.at(t.count(), frames::PoseHistory::Outside::kNearest);
  return frames::head_pose(body.value_or(frames::Pose{}), mounting);
}

}  // namespace

MultibeamHead::MultibeamHead(const MultibeamConfig& config)
    : config_(config),
      pulse_(echo::rectangular_pulse(config.pulse_length_s), 1.0 / config.sample_rate_hz),
      noise_(config.seed, config.process + "/noise"),
      beam_angle_rad_(beams_of(config)),
      beam_noise_db_(beam_noise_db_of(config)),
      scatterers_(cell_m_of(config), {config.seed, "seabed"}),
      receiver_(echo::element_line(receive_array_of(config), wavelength_m_of(config))),
      weights_{echo::beam_weights(receive_array_of(config).weights)},
      images_(1) {
  trace::Fan(fan_of(config)).fill({config.seed, config.process + "/rays"}, 0, rays_);
  const double transmit_waves = array::length_in_waves_for(config.transmit_beamwidth_rad);
  for (const trace::Ray& ray : rays_) {
    source_upa2m2_.push_back(static_cast<float>(std::pow(10.0, 0.1 * config.source_level_db) *
                                                array::line_power(transmit_waves, ray.direction_head.x())));
  }
  // A flat array's delays are made for the sound speed that the head knows; the true one turns its beams.
  const double turned = config.sound_speed_mps / config.known_sound_speed_mps();
  for (const float angle : beam_angle_rad_) {
    sin_beams_true_.push_back(static_cast<float>(std::clamp(std::sin(angle) * turned, -1.0, 1.0)));
  }
}

echo::Sampling MultibeamHead::sampling(const Shot& shot) const {
  return {0.0, 1.0 / config_.sample_rate_hz, config_.samples(shot.range_m)};
}

detect::Amplitudes MultibeamHead::listen(const Shot& shot, const frames::PoseHistory& truth,
                                         const trace::Scene& seabed) {
  trace_rays(shot, truth, seabed);
  track_receiver(shot, truth);
  const frames::HeadPose transmit = true_pose(truth, shot.transmit, config_.mounting.actual);
  arrivals_.clear();
  echo::add_direct_echoes({config_.frequency_hz, config_.absorption_dbpm}, transmit.position_enu_m,
                          scatterers_.find({transmit, rays_, hits_, source_upa2m2_, backscatter_}), receivers_,
                          arrivals_);
  echo::Background background;
  background.ping = static_cast<std::uint64_t>(shot.ping);
  background.isotropic_upa2 = std::pow(10.0, 0.1 * element_noise_db_of(config_));
  background.isotropic = &noise_;
  receiver_.form({arrivals_, {}, pulse_, sampling(shot), background}, sin_beams_true_, weights_, images_);
  if (!amplitude_upa_ || amplitude_upa_.use_count() > 1) amplitude_upa_ = std::make_shared<std::vector<float>>();
  echo::amplitude_upa(images_[0], *amplitude_upa_);
  return {images_[0].beams, images_[0].samples, sampling(shot).start_s, sampling(shot).period_s, *amplitude_upa_};
}

void MultibeamHead::trace_rays(const Shot& shot, const frames::PoseHistory& truth, const trace::Scene& seabed) {
  seabed.trace(true_pose(truth, shot.transmit, config_.mounting.actual), rays_, static_cast<float>(shot.range_m), hits_,
               config_.sound_speed_mps);
  backscatter_.resize(hits_.size());
  rays_that_hit_ = 0;
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    if (!hits_[i].hit()) continue;
    ++rays_that_hit_;
    backscatter_[i] = static_cast<float>(seabed::lambert_backscatter(config_.lambert_mu_db, hits_[i].sin_grazing));
  }
}

void MultibeamHead::track_receiver(const Shot& shot, const frames::PoseHistory& truth) {
  poses_.clear();
  const SimTime listening = config_.listening_time(shot.range_m);
  for (SimTime t{0}; t < listening + kTrackPeriod; t += kTrackPeriod) {
    poses_.push_back(true_pose(truth, shot.transmit + t, config_.mounting.actual));
  }
  receivers_.set({0.0, seconds(kTrackPeriod), poses_});
}

msg::Ping MultibeamHead::ping_message(const Shot& shot) const {
  msg::Ping ping;
  ping.stamp_ns = shot.transmit.count();
  ping.ping = shot.ping;
  ping.sample_period_s = sampling(shot).period_s;
  ping.first_sample_s = sampling(shot).start_s;
  ping.beam_angle_rad = msg::Array<float>::of(beam_angle_rad_);
  ping.amplitude_upa = msg::Array<float>::view(
      {static_cast<std::size_t>(images_[0].beams), static_cast<std::size_t>(images_[0].samples)}, amplitude_upa_,
      amplitude_upa_->data());
  ping.applied.frequency_hz = config_.frequency_hz;
  ping.applied.pulse_length_s = config_.pulse_length_s;
  ping.applied.source_level_db = config_.source_level_db;
  ping.applied.range_m = shot.range_m;
  ping.applied.sound_speed_mps = config_.known_sound_speed_mps();
  return ping;
}

std::size_t MultibeamHead::max_ping_bytes() const {
  return static_cast<std::size_t>(config_.beams) * static_cast<std::size_t>(config_.samples(config_.range_m) + 1) *
             sizeof(float) +
         65536;
}

}  // namespace ensonify
