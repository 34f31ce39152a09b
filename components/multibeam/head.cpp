#include "components/multibeam/head.h"

#include <algorithm>
#include <cmath>

#include "components/multibeam/arrays.h"
#include "components/runtime/head/head_motion.h"
#include "kernels/array/line.h"
#include "kernels/array/stabilisation.h"
#include "kernels/water/noise.h"

namespace ensonify {
namespace {

constexpr double kBeyondSwath_beamwidths = 1.5;  // of the outermost beam: to its first null and a little more
constexpr double kWidestFan_rad = 1.5;
constexpr std::size_t kFewestRays = 80'000;  // at normal quality: 20,000 at the default

double range_resolution_m(const MultibeamConfig& c) { return 0.5 * c.sound_speed_mps * c.pulse_length_s; }

trace::RayDistribution rays_of(const MultibeamConfig& c) {
  const double half = 0.5 * c.swath_rad;
  const double reach_rad =
      std::min(kWidestFan_rad, half + kBeyondSwath_beamwidths * c.receive_beamwidth_rad / std::cos(half));
  const auto volume = trace::mills_cross_volume(array::length_in_waves_for(c.transmit_beamwidth_rad),
                                                array::length_in_waves_for(c.receive_beamwidth_rad), reach_rad);
  return {volume,
          {.quality = c.quality, .range_resolution_m = range_resolution_m(c), .fewest_rays = kFewestRays},
          {c.world.seed, c.process + "/rays"}};
}

array::PatternTable transmit_pattern_of(const MultibeamConfig& c) {
  const double waves = array::length_in_waves_for(c.transmit_beamwidth_rad);
  return {[=](double sine) { return array::line_amplitude(waves, sine); }, 0.5 * waves};
}

std::vector<std::vector<float>> weights_of(const ReceiveLine& line) {
  return {echo::beam_weights(line.whole.weights), echo::beam_weights(line.halves.positive, line.whole.weights),
          echo::beam_weights(line.halves.negative, line.whole.weights)};
}

echo::ElementLine elements_of(const ReceiveLine& line) { return echo::element_line(line.whole, line.wavelength_m); }

}  // namespace

MultibeamHead::MultibeamHead(const MultibeamConfig& config)
    : config_(config),
      pulse_(echo::rectangular_pulse(config.pulse_length_s), 1.0 / config.sample_rate_hz),
      noise_(config.world.seed, config.process + "/noise"),
      environment_(config.world, config.frequency_hz),
      paths_(environment_.profile(), true),
      distribution_(rays_of(config)),
      transmit_pattern_(transmit_pattern_of(config)),
      scatterers_(range_resolution_m(config), {config.world.seed, "seabed"}),
      receiver_(elements_of(receive_line(config))),
      weights_(weights_of(receive_line(config))),
      images_(3) {}

echo::Sampling MultibeamHead::sampling(const Shot& shot) const {
  return {0.0, 1.0 / config_.sample_rate_hz, config_.samples(shot.range_m)};
}

MultibeamHead::Heard MultibeamHead::listen(const Shot& shot, const Steering& steering, const frames::PoseHistory& truth,
                                           const trace::Scene& seabed) {
  head_poses(truth, config_.mounting.actual, shot.transmit, config_.listening_time(shot.range_m), poses_);
  receivers_.set({0.0, seconds(kTrackPeriod), poses_});
  trace_rays(shot, steering, seabed);
  arrivals_.clear();
  echo::add_direct_echoes({config_.frequency_hz, absorption_dbpm_}, poses_.front().position_enu_m,
                          scatterers_.find({poses_.front(), rays_, hits_, source_upa2m2_, backscatter_}), receivers_,
                          arrivals_);
  form_beams(shot, steering);
  if (!amplitude_upa_ || amplitude_upa_.use_count() > 1) amplitude_upa_ = std::make_shared<std::vector<float>>();
  echo::amplitude_upa(images_[0], *amplitude_upa_);
  return {{images_[0].beams, images_[0].samples, sampling(shot).start_s, sampling(shot).period_s, *amplitude_upa_},
          {images_[1].envelope_upa, images_[2].envelope_upa}};
}

void MultibeamHead::trace_rays(const Shot& shot, const Steering& steering, const trace::Scene& seabed) {
  const frames::HeadPose& head = poses_.front();
  const double true_mps = paths_.sound_speed_mps(head);
  const double sin_transmit = array::true_sine(steering.sin_transmit, steering.sound_speed_mps, true_mps);
  distribution_.steer(sin_transmit, steering.middle_rad);
  paths_.trace(seabed, head, distribution_.probes(), shot.range_m, hits_);
  distribution_.fill(head, hits_, static_cast<float>(shot.range_m), rays_);
  paths_.trace(seabed, head, rays_, shot.range_m, hits_);

  // What bubbles under the hull take on the way out and on the way back is the same for all paths.
  const auto source =
      static_cast<float>(std::pow(10.0, 0.1 * config_.source_level_db - 0.2 * environment_.bubble_loss_db()));
  source_upa2m2_.resize(hits_.size());
  backscatter_.resize(hits_.size());
  rays_that_hit_ = 0;
  double height_m = 0.0;
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    if (!hits_[i].hit()) continue;
    ++rays_that_hit_;
    height_m += hits_[i].position_enu_m.z();
    source_upa2m2_[i] = source * transmit_pattern_.power(rays_[i].direction_head.x() - sin_transmit);
    backscatter_[i] = environment_.backscatter()(hits_[i].sediment, hits_[i].sin_grazing);
  }
  const double head_depth_m = -head.position_enu_m.z();
  absorption_dbpm_ =
      environment_.absorption_dbpm(head_depth_m, rays_that_hit_ > 0 ? -height_m / rays_that_hit_ : head_depth_m);
}

void MultibeamHead::form_beams(const Shot& shot, const Steering& steering) {
  // A flat array's delays are made for the sound speed that the head believes in; the true one turns its beams.
  const double true_mps = paths_.sound_speed_mps(poses_.front());
  sin_beams_true_.clear();
  for (const float sine : steering.sin_beams) {
    sin_beams_true_.push_back(
        static_cast<float>(std::clamp(array::true_sine(sine, steering.sound_speed_mps, true_mps), -1.0, 1.0)));
  }
  echo::Background background;
  background.ping = static_cast<std::uint64_t>(shot.ping);
  background.isotropic_upa2 =
      std::pow(10.0, 0.1 * water::in_band_level_db(environment_.noise_level_db(), 1.0 / config_.pulse_length_s, 0.0));
  background.isotropic = &noise_;
  receiver_.form({arrivals_, {}, pulse_, sampling(shot), background}, sin_beams_true_, weights_, images_);
}

msg::Ping MultibeamHead::ping_message(const Shot& shot, const Steering& steering) const {
  msg::Ping ping;
  ping.stamp_ns = shot.transmit.count();
  ping.ping = shot.ping;
  ping.kind = "multibeam";
  ping.sample_period_s = sampling(shot).period_s;
  ping.first_sample_s = sampling(shot).start_s;
  ping.beam_angle_rad = msg::Array<float>::of(steering.beam_angle_rad);
  ping.amplitude_upa = msg::Array<float>::view(
      {static_cast<std::size_t>(images_[0].beams), static_cast<std::size_t>(images_[0].samples)}, amplitude_upa_,
      amplitude_upa_->data());
  ping.applied = applied(shot, steering);
  return ping;
}

msg::AppliedSettings MultibeamHead::applied(const Shot& shot, const Steering& steering) const {
  msg::AppliedSettings applied;
  applied.frequency_hz = config_.frequency_hz;
  applied.pulse_length_s = config_.pulse_length_s;
  applied.source_level_db = config_.source_level_db;
  applied.range_m = shot.range_m;
  applied.ping_rate_hz = config_.ping_rate_hz;
  applied.swath_rad = config_.swath_rad;
  applied.transmit_beamwidth_rad = config_.transmit_beamwidth_rad;
  applied.receive_beamwidth_rad = config_.receive_beamwidth_rad;
  applied.roll_stabilised = steering.roll_stabilised;
  applied.pitch_stabilised = steering.pitch_stabilised;
  applied.sound_speed_mps = steering.sound_speed_mps;
  return applied;
}

std::size_t MultibeamHead::max_ping_bytes() const {
  return static_cast<std::size_t>(config_.beams) * static_cast<std::size_t>(config_.samples(config_.range_m) + 1) *
             sizeof(float) +
         65536;
}

}  // namespace ensonify
