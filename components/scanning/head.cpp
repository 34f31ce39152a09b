#include "components/scanning/head.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "components/sonar/head_motion.h"
#include "components/sonar/ranged_pulse.h"
#include "kernels/acoustics/array/aperture.h"
#include "kernels/acoustics/array/line.h"

namespace ensonify {
namespace {

constexpr double kNominalSpeed_mps = 1500.0;
constexpr double kBackLoss_db = 40.0;
constexpr double kReach = 6.0;  // sines to either side that rays go to, in lambda / L of a uniform line as wide

double tall_in_waves(const ScanningConfig& config) { return array::length_in_waves_for(config.vertical_beamwidth_rad); }

/// The transducer across its narrow beam, in wavelengths.
LineDesign narrow_line(const ScanningConfig& config) {
  return {config.horizontal_beamwidth_rad, 1.0, config.shading, config.quality.pattern_error()};
}

array::Pattern pattern_of(const ScanningConfig& config, const LineDesign& line) {
  const double tall = tall_in_waves(config);
  const auto vertical = std::make_shared<array::PatternTable>(
      [=](double sine) { return array::line_amplitude(tall, sine); }, 0.5 * tall, config.quality.pattern_error());
  const auto first_null = static_cast<float>(config.effects.side_lobes ? 2.0 : line.first_null);
  const auto cosine = static_cast<float>(std::cos(config.tilt_rad)),
             sine = static_cast<float>(std::sin(config.tilt_rad));
  const Eigen::Vector3f axis(cosine, 0.0F, sine), up_the_face(sine, 0.0F, -cosine);
  array::Pattern pattern;
  pattern.times(array::LineFactor{.table = line.pattern, .axis_head = Eigen::Vector3f::UnitY(), .end = first_null});
  if (!config.effects.directivity) return pattern;
  return pattern.times(array::LineFactor{.table = vertical, .axis_head = up_the_face})
      .times(array::FaceFactor{axis, array::Face(0.0, kBackLoss_db)});
}

double resolution_m(const ScanningConfig& config) {
  return 0.5 * kNominalSpeed_mps / pulse_at(config.pulse, config.range_m, config.sound_speed_mps).band_hz;
}

Apertures apertures_of(const ScanningConfig& config, const LineDesign& line) {
  Apertures a;
  a.frequency_hz = config.frequency_hz;
  a.patterns.transmit = a.patterns.receive = {pattern_of(config, line)};
  a.directivity_index_db = array::directivity_index_db(line.effective_in_waves, tall_in_waves(config));
  a.electronic_noise_db = config.electronic_noise_db;
  a.narrowest_rad = config.horizontal_beamwidth_rad;
  a.narrow_axis_head = Eigen::Vector3f::UnitY();
  a.resolution_m = resolution_m(config);
  a.seed = config.world->seed;
  a.process = config.process;
  return a;
}

trace::RayDistribution rays_of(const ScanningConfig& config, const LineDesign& line) {
  const double tall = tall_in_waves(config);
  const double axis = std::sin(config.tilt_rad);
  const double null_rad = std::asin(line.first_null),
               reach_rad = std::asin(std::min(1.0, kReach / line.uniform_in_waves));
  trace::TransmitVolume volume;
  volume.axis = trace::TransmitVolume::Axis::kDown;
  volume.sine = {-1.0, 1.0, std::max(-1.0, axis - 1.0 / tall), std::min(1.0, axis + 1.0 / tall),
                 2.0 * array::half_power_half_width(tall)};
  volume.angle_rad = {-reach_rad, reach_rad, -null_rad, null_rad, config.horizontal_beamwidth_rad};
  return {volume, config.quality.ray_settings(resolution_m(config)), {config.world->seed, config.process + "/rays"}};
}

}  // namespace

array::Pattern scanning_pattern(const ScanningConfig& config) { return pattern_of(config, narrow_line(config)); }

ScanningHead::ScanningHead(const ScanningConfig& config) : ScanningHead(config, narrow_line(config)) {}

ScanningHead::ScanningHead(const ScanningConfig& config, const LineDesign& line)
    : config_(config),
      echoes_(apertures_of(config, line), std::make_shared<const Environment>(*config.world, config.frequency_hz),
              config.effects, config.quality, rays_of(config, line)) {}

ScanningHead::Received ScanningHead::receive_echoes(const PingEvent& event, const HeadSettings& settings,
                                                    double known_sound_speed_mps, const frames::PoseHistory& truth,
                                                    const trace::Scene& seabed) {
  Scan scan = config_.scan;
  scan.width_rad = settings.swath_rad;
  const double angle_rad = scan_angle_rad(scan, event.ping);
  const RangedPulse ranged = pulse_for(settings);
  head_poses(truth, config_.mounting.actual, event.transmit, from_seconds(ranged.reception_s()), poses_);
  const frames::Quaternion turned(Eigen::AngleAxisd(angle_rad, frames::Vec3::UnitZ()));  // forward towards starboard
  for (frames::HeadPose& pose : poses_) pose.enu_from_head = pose.enu_from_head * turned;
  Emission emission;
  emission.event = event;
  emission.source_level_db = settings.source_level_db;
  emission.sample_period_s = ranged.sampling.period_s;
  emission.reception_s = (ranged.sampling.count - 0.5) * ranged.sampling.period_s;
  const auto [image, trace] =
      echoes_.receive_echoes(emission, echo_pulse(config_.pulse, ranged), poses_, seabed, memory_);

  Received received{ping_message(event, "scanning", config_.frequency_hz, settings, known_sound_speed_mps), trace};
  msg::Ping& ping = received.ping;
  ping.beam_angle_rad = msg::Array<float>::of({static_cast<float>(angle_rad)});
  write_samples(tvg_of(settings, known_sound_speed_mps), config_.converter_in_use(), ranged.sampling, image, ping);
  fill_shape(false, config_.pulse.tapered_fraction, ping.applied);
  ping.applied.pulse_length_s = ranged.length_s;
  ping.applied.transmit_beamwidth_rad = config_.vertical_beamwidth_rad;
  ping.applied.receive_beamwidth_rad = config_.horizontal_beamwidth_rad;
  return received;
}

std::size_t ScanningHead::max_ping_bytes() const {
  return static_cast<std::size_t>(config_.pulse.most_samples) * sizeof(float) + 65536;
}

}  // namespace ensonify
