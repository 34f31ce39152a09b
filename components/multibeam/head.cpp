#include "components/multibeam/head.h"

#include <algorithm>
#include <cmath>

#include "kernels/array/line.h"
#include "kernels/seabed/lambert.h"
#include "kernels/water/noise.h"

namespace ensonify {
namespace {

constexpr int kRaysAlong = 20;
constexpr double kBeyondSwath_beamwidths = 1.5;  // of the outermost beam: to its first null and a little more
constexpr double kWidestFan_rad = 1.5;
constexpr SimTime kTrackPeriod = std::chrono::milliseconds(5);

echo::Sonar sonar_of(const MultibeamConfig& c) {
  echo::Sonar sonar;
  sonar.source_level_db = c.source_level_db;
  sonar.pulse_length_s = c.pulse_length_s;
  sonar.transmit_length_in_waves = array::length_in_waves_for(c.transmit_beamwidth_rad);
  sonar.receive_length_in_waves = array::length_in_waves_for(c.receive_beamwidth_rad);
  sonar.sound_speed_mps = c.sound_speed_mps;
  sonar.absorption_dbpm = c.absorption_dbpm;
  return sonar;
}

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

/// Isotropic noise against a line array: DI = 10 log10(2 L / lambda) [Lurton2010, ch. 5]; the band is the pulse's.
double beam_noise_db_of(const MultibeamConfig& c) {
  const double directivity_db = 10.0 * std::log10(2.0 * array::length_in_waves_for(c.receive_beamwidth_rad));
  return water::in_band_level_db(c.noise_level_db, 1.0 / c.pulse_length_s, directivity_db);
}

frames::HeadPose true_pose(const frames::PoseHistory& truth, SimTime t, const frames::Mounting& mounting) {
  const auto body = truth.at(t.count(), frames::PoseHistory::Outside::kNearest);
  return frames::head_pose(body.value_or(frames::Pose{}), mounting);
}

}  // namespace

MultibeamHead::MultibeamHead(const MultibeamConfig& config)
    : config_(config),
      sonar_(sonar_of(config)),
      fan_(fan_of(config)),
      ray_jitter_(config.seed, config.process + "/rays"),
      ray_phase_(config.seed, config.process + "/phase"),
      noise_(config.seed, config.process + "/noise"),
      beam_angle_rad_(beams_of(config)),
      beam_noise_db_(beam_noise_db_of(config)) {
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
  const auto ping = static_cast<std::uint64_t>(shot.ping);
  echo::accumulate(sonar_, sin_beams_true_, sampling(shot), {ping, rays_, hits_, backscatter_},
                   {0.0, seconds(kTrackPeriod), receiver_}, ray_phase_, workspace_, image_);
  echo::add_noise(beam_noise_db_, ping, noise_, image_);
  if (!amplitude_upa_ || amplitude_upa_.use_count() > 1) amplitude_upa_ = std::make_shared<std::vector<float>>();
  echo::amplitude_upa(image_, *amplitude_upa_);
  return {image_.beams, image_.samples, sampling(shot).start_s, sampling(shot).period_s, *amplitude_upa_};
}

void MultibeamHead::trace_rays(const Shot& shot, const frames::PoseHistory& truth, const trace::Scene& seabed) {
  fan_.fill(ray_jitter_, static_cast<std::uint64_t>(shot.ping), rays_);
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
  receiver_.clear();
  const SimTime listening = config_.listening_time(shot.range_m);
  for (SimTime t{0}; t < listening + kTrackPeriod; t += kTrackPeriod) {
    receiver_.push_back(true_pose(truth, shot.transmit + t, config_.mounting.actual));
  }
}

msg::Ping MultibeamHead::ping_message(const Shot& shot) const {
  msg::Ping ping;
  ping.stamp_ns = shot.transmit.count();
  ping.ping = shot.ping;
  ping.sample_period_s = sampling(shot).period_s;
  ping.first_sample_s = sampling(shot).start_s;
  ping.beam_angle_rad = msg::Array<float>::of(beam_angle_rad_);
  ping.amplitude_upa =
      msg::Array<float>::view({static_cast<std::size_t>(image_.beams), static_cast<std::size_t>(image_.samples)},
                              amplitude_upa_, amplitude_upa_->data());
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
