#include "components/scanning/head.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

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
  const auto vertical = array::uniform_line_table(tall, config.quality.pattern_error());
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

ApertureEchoes echoes_of(const ScanningConfig& config, const LineDesign& line, const Effects& effects) {
  Apertures a;
  a.frequency_hz = config.frequency_hz;
  a.patterns.transmit = a.patterns.receive = {pattern_of(config, line)};
  a.directivity_index_db = array::directivity_index_db(line.effective_in_waves, tall_in_waves(config));
  a.electronic_noise_db = config.electronic_noise_db;
  a.narrowest_rad = config.horizontal_beamwidth_rad;
  a.narrow_axis_head = Eigen::Vector3f::UnitY();
  a.resolution_m = resolution_m(config);
  a.seed = config.world->seed;
  a.drawn_seed = config.drawn_seed();
  a.process = config.process;
  return {a, std::make_shared<const Environment>(*config.world, config.frequency_hz), effects, config.quality};
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
  return {volume,
          config.quality.ray_settings(resolution_m(config), config.most_rays),
          {config.world->seed, config.process + "/rays"}};
}

/// All elevations of the main lobe.
LabelView label_view_of(const ScanningConfig& config, const LineDesign& line, const array::Pattern& receive) {
  const double half_rad = std::asin(std::min(1.0, 1.0 / tall_in_waves(config)));
  LabelView view;
  view.axes = {Eigen::Vector3f::UnitY(), Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitZ()};
  view.sectors = {{config.tilt_rad - half_rad, config.tilt_rad + half_rad, &receive}};
  view.lobe = aperture_lobe(line);
  return view;
}

}  // namespace

array::Pattern scanning_pattern(const ScanningConfig& config) { return pattern_of(config, narrow_line(config)); }

HeadPlan Scanning::plan(const Config& config) {
  return {.channels = {{"", config.start(), config.limits(), {{config.frequency_hz}}}},
          .longest_reception_s = longest_reception_s(config.pulse, config.longest_range_m, config.sound_speed_mps),
          .finest_beam_rad = config.horizontal_beamwidth_rad,
          .beam_axis = BeamAxis::kForward,
          .probe = true};
}

Scanning::Scanning(const Config& config, std::size_t) : Scanning(config, narrow_line(config)) {}

Scanning::Scanning(const Config& config, const LineDesign& line)
    : config_(config),
      rays_(rays_of(config, line)),
      echoes_(echoes_of(config, line, config.effects)),
      label_row_(aperture_row(line)) {
  if (config.labels != LabelKind::kNone) labeller_.emplace(label_view_of(config, line, echoes_.receive().front()));
  if (config.labels == LabelKind::kEnergies)
    expectation_.emplace(echoes_of(config, line, without_speckle(config.effects)));
}

HeadOutputs<msg::Ping, msg::Labels, msg::Energies> Scanning::outputs() const {
  const std::size_t bytes = static_cast<std::size_t>(config_.pulse.most_samples) * sizeof(float) + 65536;
  return {{"ping", bytes},
          {"labels", bytes, config_.labels != LabelKind::kNone},
          {"energies", kEnergySources * bytes, config_.labels == LabelKind::kEnergies}};
}

SentPing Scanning::transmit(SimTime, const HeadSettings& settings, const Surroundings& around) const {
  const RangedPulse pulse = pulse_for(settings);
  return {{{config_.frequency_hz, pulse.length_s, from_seconds(pulse.reception_s()), settings}},
          around.sound_speed_mps};
}

RangedPulse Scanning::pulse_for(const HeadSettings& settings) const {
  return pulse_at(config_.pulse, settings.range_m, config_.sound_speed_mps, settings.pulse_length_s);
}

Scanning::Design Scanning::prepare(const HeadSettings& settings) const {
  const RangedPulse ranged = pulse_for(settings);
  return {settings.range_m,
          settings.pulse_length_s,
          ranged,
          {echo_pulse(config_.pulse, ranged), ranged.sampling.period_s, echoes_.cells(), rays_}};
}

Scanning::Report Scanning::ping(const PingEvent& event, const SentPing& sent, const Surroundings& around) {
  const Transmission& transmission = sent.sectors.front();
  const HeadSettings& settings = transmission.settings;
  const Design& design = design_of(*this, settings, memory_.design);
  const SeaAcoustics& sea = echoes_.sea();
  Scan scan = config_.scan;
  scan.width_rad = settings.swath_rad;
  const double angle_rad = scan_angle_rad(scan, event.ping);
  const frames::Quaternion turned(Eigen::AngleAxisd(angle_rad, frames::Vec3::UnitZ()));  // forward towards starboard
  head_poses(around.truth, config_.mounting.actual, event.transmit, transmission.reception, memory_.poses);
  for (frames::HeadPose& pose : memory_.poses) pose.enu_from_head = pose.enu_from_head * turned;
  const Shot shot{.poses = memory_.poses,
                  .transmit_s = seconds(event.transmit),
                  .source_level_db = settings.source_level_db,
                  .transmit = echoes_.transmit(),
                  .latest_s = latest_arrival_s(design.ranged.sampling, design.shot.pulse)};

  const trace::Mesh mesh = sea.mesh(shot, around.seabed, design.shot.rays, event.range_m);
  const Insonified insonified =
      sea.insonify(shot, mesh, design.shot.rays, design.shot.cells, event.range_m, memory_.shot);
  const Echoed echoed = sea.echoes(shot, insonified, memory_.shot);
  const echo::Arrivals& foreign = sea.interference(shot, echoed, event.interfering, design.shot.pulse, memory_.shot);
  const echo::Image& image =
      echoes_.beamform(shot, echoed, design.shot, {event.number(), design.ranged.sampling, foreign}, memory_.beams);

  std::optional<msg::Labels> labels;
  if (labeller_) {
    const std::vector<float> background =
        echoes_.expected_background_upa2(design.shot.pulse, design.ranged.sampling, memory_.beams);
    labels = labeller_->labels(sea, shot, mesh, echoed, design.shot,
                               {event, {&label_row_, 1}, design.ranged.sampling, background, event.range_m},
                               memory_.shot, memory_.labels);
  }
  std::optional<msg::Energies> energies;
  if (expectation_) {
    const auto receive = [&](const echo::Arrivals& of_others) {
      return ApertureReception{event.number(), design.ranged.sampling, of_others};
    };
    energies = expectation_->of({event, 1, design.ranged.sampling}, shot, mesh, insonified, design.shot, receive,
                                memory_.expected);
  }
  return {.messages = {ping_message(event, sent, design, angle_rad, image), std::move(labels), std::move(energies)},
          .trouble = no_echo_reason(echoed.summary(shot, event.range_m, around.seabed))};
}

msg::Ping Scanning::ping_message(const PingEvent& event, const SentPing& sent, const Design& design, double angle_rad,
                                 const echo::Image& image) const {
  const HeadSettings& settings = sent.sectors.front().settings;
  msg::Ping ping = ensonify::ping_message(event, kComponent, config_.frequency_hz, settings, sent.sound_speed_mps);
  ping.beam_angle_rad = msg::Array<float>::of({static_cast<float>(angle_rad)});
  write_samples(tvg_of(settings, sent.sound_speed_mps), config_.converter_in_use(), design.ranged.sampling, image,
                ping);
  fill_shape(false, config_.pulse.tapered_fraction, ping.applied);
  ping.applied.pulse_length_s = design.ranged.length_s;
  ping.applied.transmit_beamwidth_rad = config_.vertical_beamwidth_rad;
  ping.applied.receive_beamwidth_rad = config_.horizontal_beamwidth_rad;
  return ping;
}

}  // namespace ensonify
