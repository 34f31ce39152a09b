#include "components/echosounder/head.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "components/sonar/head_motion.h"
#include "components/sonar/ranged_pulse.h"
#include "kernels/acoustics/array/aperture.h"
#include "kernels/acoustics/array/line.h"

namespace ensonify {
namespace {

constexpr double kBackLoss_db = 40.0;  // one-way, behind the face
constexpr double kWidest_rad = 1.5;    // that rays are sent to: echoes end with the range, not with an angle

bool circular(const EchosounderConfig& c) { return c.face == EchosounderConfig::Face::kCircular; }

/// Diameter or side over wavelength. A piston's half-power width is 58.96 / 50.76 times that of a line as long.
double size_in_waves(const EchosounderConfig& c) {
  return array::length_in_waves_for(c.beamwidth_rad) * (circular(c) ? 58.96 / 50.76 : 1.0);
}

double range_resolution_m(const EchosounderConfig& c) { return 0.5 * c.sound_speed_mps * c.pulse_length_s; }

array::Pattern pattern_of(const EchosounderConfig& c) {
  array::Pattern pattern;
  if (!c.effects.directivity) return pattern;
  const double size = size_in_waves(c);
  const bool round = circular(c);
  const auto table = std::make_shared<array::PatternTable>(
      [=](double sine) { return round ? array::piston_amplitude(size, sine) : array::line_amplitude(size, sine); },
      0.5 * size, c.quality.pattern_error());
  const auto end = static_cast<float>(c.effects.side_lobes ? 2.0 : (round ? 1.2197 : 1.0) / size);
  if (round) {
    pattern.times(array::PistonFactor{table, end});
  } else {
    pattern.times(array::LineFactor{.table = table, .axis_head = Eigen::Vector3f::UnitX(), .end = end})
        .times(array::LineFactor{.table = table, .axis_head = Eigen::Vector3f::UnitY(), .end = end});
  }
  return pattern.times(array::FaceFactor{.face = array::Face(0.0, kBackLoss_db)});
}

Apertures apertures_of(const EchosounderConfig& config) {
  Apertures a;
  a.frequency_hz = config.frequency_hz;
  a.patterns.transmit = a.patterns.receive = {pattern_of(config)};
  a.directivity_index_db = array::directivity_index_db(size_in_waves(config), size_in_waves(config));
  if (circular(config)) a.directivity_index_db += 10.0 * std::log10(0.25 * std::acos(-1.0));  // the lesser area
  a.electronic_noise_db = config.electronic_noise_db;
  a.narrowest_rad = config.beamwidth_rad;
  a.nearest_m = 1.0;
  a.resolution_m = range_resolution_m(config);
  a.seed = config.world->seed;
  a.process = config.process;
  return a;
}

trace::RayDistribution rays_of(const EchosounderConfig& c) {
  const double first_null = std::min(1.0, (circular(c) ? 1.2197 : 1.0) / size_in_waves(c));
  const double null_rad = std::min(kWidest_rad, std::asin(first_null));
  const trace::TransmitVolume volume{trace::TransmitVolume::Axis::kForward,
                                     {-1.0, 1.0, -first_null, first_null, 2.0 * std::sin(0.5 * c.beamwidth_rad)},
                                     {-kWidest_rad, kWidest_rad, -null_rad, null_rad, c.beamwidth_rad}};
  return {volume, c.quality.ray_settings(range_resolution_m(c)), {c.world->seed, c.process + "/rays"}};
}

detect::FirstBottomSettings bottom_of(const EchosounderConfig& config) {
  detect::FirstBottomSettings settings;
  settings.threshold_db = config.bottom_threshold_db;
  settings.column_m = EchosounderConfig::kLeastColumn_m;
  settings.blanking_m = config.least_range_m - settings.column_m;
  settings.persistence_m = 0.1;  // straight down, an echo lasts little longer than the pulse
  return settings;
}

}  // namespace

EchosounderHead::EchosounderHead(const EchosounderConfig& config)
    : config_(config),
      echoes_(apertures_of(config), std::make_shared<const Environment>(*config.world, config.frequency_hz),
              config.effects, config.quality, rays_of(config)),
      bottom_(bottom_of(config)) {}

EchosounderHead::Received EchosounderHead::receive_echoes(const PingEvent& event, const HeadSettings& settings,
                                                          const frames::PoseHistory& vehicle,
                                                          const trace::Scene& seabed) {
  Emission emission;
  emission.event = event;
  emission.source_level_db = settings.source_level_db;
  emission.reception_s = config_.reception_s(settings);
  emission.sample_period_s = config_.sample_period_s();
  head_poses(vehicle, config_.mounting.actual, event.transmit, from_seconds(emission.reception_s), poses_);
  const echo::Pulse pulse = echo::tapered_pulse(settings.pulse_length_s, config_.tapered_fraction);
  const auto [image, trace] = echoes_.receive_echoes(emission, pulse, poses_, seabed, memory_);

  Received received;
  received.trace = trace;
  const echo::Sampling sampling{0.0, emission.sample_period_s, image.samples};
  received.bottom = bottom_.find(image, sampling, pulse, config_.sound_speed_mps);
  received.ping = ping_message(event, "echosounder", config_.frequency_hz, settings, config_.sound_speed_mps);
  received.bottom.stamp_ns = received.ping.stamp_ns;
  received.bottom.ping = received.ping.ping;
  received.ping.beam_angle_rad = msg::Array<float>::of({0.0F});
  fill_shape(false, config_.tapered_fraction, received.ping.applied);
  received.ping.applied.transmit_beamwidth_rad = received.ping.applied.receive_beamwidth_rad = config_.beamwidth_rad;
  write_samples(tvg_of(settings, config_.sound_speed_mps), config_.converter_in_use(), sampling, image, received.ping);
  return received;
}

}  // namespace ensonify
