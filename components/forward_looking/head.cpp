#include "components/forward_looking/head.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "components/sonar/head_motion.h"
#include "components/sonar/ranged_pulse.h"
#include "kernels/acoustics/array/beam_layout.h"
#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/array/near_field.h"

namespace ensonify {
namespace {

constexpr double kBackLoss_db = 40.0;

/// cos^q is -3 dB at half the aperture.
float cosine_power(double aperture_rad) {
  return static_cast<float>(std::log(std::sqrt(0.5)) / std::log(std::cos(0.5 * aperture_rad)));
}

Eigen::Vector3f in_vertical_plane(double down_rad) {
  return {static_cast<float>(std::cos(down_rad)), 0.0F, static_cast<float>(std::sin(down_rad))};
}

constexpr double kNominalSpeed_mps = 1500.0;  // for which arrays are built
constexpr double kBeyondAperture_rad = 0.15;  // to where rays go, for the beams' side lobes
constexpr double kWidest_rad = 1.5;
constexpr double kVolumeStep_rad = 0.5 * std::numbers::pi / 180.0;

/// Where side lobes are switched off: Dolph-Chebyshev weights, which put them at -60 dB and widen the main lobe.
std::vector<float> weights_of(const array::LineArray& array, bool side_lobes) {
  if (side_lobes) return echo::beam_weights(array.weights);
  return echo::beam_weights(array::shading_weights({array::Shading::Window::kDolphChebyshev, 60.0}, array.elements()));
}

/// True, at the depth of the mission.
double wavelength_m(const ForwardLookingConfig& config) {
  return true_profile(*config.world).speed_mps(config.world->mission.depth_m) / config.frequency_hz;
}

/// The receive array.
LineDesign line_of(const ForwardLookingConfig& config) {
  return {config.beamwidth_rad, kNominalSpeed_mps / config.frequency_hz, config.shading,
          config.quality.pattern_error()};
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

/// All elevations of the main lobe of the narrower face, and the main lobe of a beam.
LabelView label_view_of(const ForwardLookingConfig& config, const LineDesign& line, const array::Pattern& element) {
  constexpr int kSteps = 256;
  const double tall = array::length_in_waves_for(std::min(config.transmit_vertical_rad, config.receive_vertical_rad));
  const double half_rad = std::asin(std::min(1.0, 1.0 / tall));
  LabelView view;
  view.axes = {Eigen::Vector3f::UnitY(), Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitZ()};
  view.sectors = {{config.tilt_rad - half_rad, config.tilt_rad + half_rad, &element}};
  view.lobe.null = line.first_null;
  for (int i = 0; i <= kSteps; ++i)
    view.lobe.power.push_back(
        static_cast<float>(array::power(line.line, line.wavelength_m, line.first_null * i / kSteps)));
  return view;
}

/// Cells of beams: each direction belongs to the nearest axis.
std::vector<label::Row> rows_of(std::span<const float> sin_beams) {
  std::vector<label::Row> rows;
  for (std::size_t b = 0; b < sin_beams.size(); ++b) {
    const auto at = [&](std::size_t beam) { return static_cast<double>(sin_beams[beam]); };
    const double axis = at(b);
    const double below = b > 0 ? 0.5 * (axis - at(b - 1)) : 0.5 * (at(b + 1) - axis);
    const double above = b + 1 < sin_beams.size() ? 0.5 * (at(b + 1) - axis) : below;
    rows.push_back({axis, axis - below, axis + above, 0});
  }
  return rows;
}

ArrayEchoes echoes_of(const ForwardLookingConfig& config, const array::LineArray& line, const ForwardFaces& faces,
                      const Effects& effects) {
  ReceiveArray array;
  array.frequency_hz = config.frequency_hz;
  array.elements = echo::element_line(line, wavelength_m(config));
  array.weights = {weights_of(line, config.effects.side_lobes)};
  array.element = faces.element;
  array.noise_share = faces.noise_share();
  array.electronic_noise_db = config.electronic_noise_db;
  array.seed = config.drawn_seed();
  array.process = config.process;
  return {array, std::make_shared<const Environment>(*config.world, config.frequency_hz), effects, config.quality};
}

}  // namespace

ForwardFaces::ForwardFaces(const ForwardLookingConfig& config, double element_in_waves) {
  if (!config.effects.directivity) return;
  const double error = config.quality.pattern_error();
  const array::FaceFactor face{in_vertical_plane(config.tilt_rad), array::Face(0.0, kBackLoss_db)};
  const Eigen::Vector3f up_the_face = in_vertical_plane(config.tilt_rad - 0.5 * std::numbers::pi);
  const auto vertical = [&](double beamwidth_rad) {
    return array::LineFactor{.table = array::uniform_line_table(array::length_in_waves_for(beamwidth_rad), error),
                             .axis_head = up_the_face};
  };
  transmit.times_power(array::CosineFactor{cosine_power(config.aperture_rad)})
      .times_power(face)
      .times_power(vertical(config.transmit_vertical_rad));
  element
      .times(array::LineFactor{.table = array::uniform_line_table(element_in_waves, error),
                               .axis_head = Eigen::Vector3f::UnitY()})
      .times(vertical(config.receive_vertical_rad))
      .times(face);
}

double ForwardFaces::noise_share() const {
  constexpr int kSteps = 3600;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const auto amplitude =
        static_cast<double>(element.amplitude(in_vertical_plane(2.0 * std::numbers::pi * i / kSteps)));
    sum += amplitude * amplitude / kSteps;
  }
  return sum;
}

HeadPlan ForwardLooking::plan(const Config& config) {
  return {.channels = {{"", config.start(), config.limits(), {{config.frequency_hz}}}},
          .longest_reception_s = longest_reception_s(config.pulse, config.longest_range_m, config.sound_speed_mps),
          .finest_beam_rad = config.beamwidth_rad,
          .beam_axis = BeamAxis::kForward,
          .near_field_m = near_field_m(config),
          .probe = true};
}

ForwardLooking::ForwardLooking(const Config& config, std::size_t)
    : config_(config),
      line_(line_of(config)),
      faces_(config, line_.line.element_length_m / wavelength_m(config)),
      echoes_(echoes_of(config, line_.line, faces_, config.effects)),
      beam_angle_rad_(array::equiangular_beams_rad(0.5 * config.aperture_rad, config.beams)),
      volume_directions_(echoes_.volume_directions(
          [this](const Eigen::Vector3f& direction) { return faces_.transmit.power(direction); }, kVolumeStep_rad)),
      label_view_(label_view_of(config, line_, faces_.element)) {
  if (config.labels != LabelKind::kNone) labeller_.emplace(label_view_);
  if (config.labels == LabelKind::kEnergies)
    expectation_.emplace(echoes_of(config, line_.line, faces_, without_speckle(config.effects)));
}

HeadOutputs<msg::Ping, msg::Labels, msg::Energies> ForwardLooking::outputs() const {
  const auto samples = static_cast<std::size_t>(config_.beams) * static_cast<std::size_t>(config_.pulse.most_samples);
  const std::size_t bytes = samples * sizeof(float) + 65536;
  return {{"ping", bytes},
          {"labels", bytes, config_.labels != LabelKind::kNone},
          {"energies", kEnergySources * bytes, config_.labels == LabelKind::kEnergies}};
}

SentPing ForwardLooking::transmit(SimTime, const HeadSettings& settings, const Surroundings& around) const {
  const RangedPulse pulse = pulse_for(settings);
  const double bandwidth_hz = config_.pulse.chirp ? pulse.band_hz : 0.0;
  return {{{config_.frequency_hz, pulse.length_s, from_seconds(pulse.reception_s()), settings, bandwidth_hz}},
          around.sound_speed_mps};
}

double near_field_m(const ForwardLookingConfig& config) {
  const LineDesign design = line_of(config);
  return array::near_field_range_m(design.line, design.wavelength_m);
}

RangedPulse ForwardLooking::pulse_for(const HeadSettings& settings) const {
  return pulse_at(config_.pulse, settings.range_m, config_.sound_speed_mps, settings.pulse_length_s);
}

ForwardLooking::Design ForwardLooking::prepare(const HeadSettings& settings) const {
  const RangedPulse ranged = pulse_for(settings);
  const double resolution_m = 0.5 * kNominalSpeed_mps / ranged.band_hz;
  return {settings.range_m,
          settings.pulse_length_s,
          ranged,
          {echo_pulse(config_.pulse, ranged), ranged.sampling.period_s,
           echo::SpeckleCells(patch_m(0.5 * resolution_m, config_.quality.rays),
                              {config_.world->seed, "seabed", config_.drawn_seed()}),
           trace::RayDistribution(volume_of(config_), config_.quality.ray_settings(resolution_m, config_.most_rays),
                                  {config_.world->seed, config_.process + "/rays"})}};
}

ForwardLooking::Report ForwardLooking::ping(const PingEvent& event, const SentPing& sent, const Surroundings& around) {
  const Transmission& transmission = sent.sectors.front();
  const HeadSettings& settings = transmission.settings;
  const Design& design = design_of(*this, settings, memory_.design);
  const echo::Sampling& sampling = design.ranged.sampling;
  const SeaAcoustics& sea = echoes_.sea();
  head_poses(around.truth, config_.mounting.actual, event.transmit, transmission.reception, memory_.poses);
  const Shot shot{.poses = memory_.poses,
                  .transmit_s = seconds(event.transmit),
                  .source_level_db = settings.source_level_db,
                  .transmit = {&faces_.transmit, 1},
                  .latest_s = latest_arrival_s(sampling, design.shot.pulse)};
  const double true_mps = sea.sound_speed_mps(shot.pose());
  // The window is set by the head's sound speed; sound travels by the true one.
  const double reach_m = 0.5 * true_mps * sampling.count * sampling.period_s;
  point_beams(true_mps, sent.sound_speed_mps, memory_.sin_beams);

  const trace::Mesh mesh = sea.mesh(shot, around.seabed, design.shot.rays, reach_m);
  const Insonified insonified = sea.insonify(shot, mesh, design.shot.rays, design.shot.cells, reach_m, memory_.shot);
  const Echoed echoed = sea.echoes(shot, insonified, memory_.shot);
  const echo::Arrivals& foreign = sea.interference(shot, echoed, event.interfering, design.shot.pulse, memory_.shot);
  const ArrayReception reception{event.number(), sampling, memory_.sin_beams, volume_directions_, foreign};
  const auto images = echoes_.beamform(shot, echoed, design.shot, reception, memory_.beams);
  std::optional<msg::Labels> labels;
  if (labeller_) labels = labels_of(event, shot, mesh, echoed, design, reception, reach_m);
  std::optional<msg::Energies> energies;
  if (expectation_) {
    const auto receive = [&](const echo::Arrivals& of_others) {
      return ArrayReception{event.number(), sampling, memory_.sin_beams, volume_directions_, of_others};
    };
    energies = expectation_->of({event, config_.beams, sampling}, shot, mesh, insonified, design.shot, receive,
                                memory_.expected);
  }

  return {.messages = {ping_message(event, sent, design, images.front()), std::move(labels), std::move(energies)},
          .trouble = no_echo_reason(echoed.summary(shot, settings.range_m, around.seabed))};
}

msg::Labels ForwardLooking::labels_of(const PingEvent& event, const Shot& shot, const trace::Mesh& mesh,
                                      const Echoed& echoed, const Design& design, const ArrayReception& reception,
                                      double reach_m) {
  const std::vector<label::Row> rows = rows_of(reception.sin_beams);
  const std::vector<float> background =
      echoes_.expected_background_upa2(design.shot.pulse, reception, label_view_.lobe, memory_.beams);
  return labeller_->labels(echoes_.sea(), shot, mesh, echoed, design.shot,
                           {event, rows, reception.sampling, background, reach_m}, memory_.shot, memory_.labels);
}

/// Delays are made for the sound speed that the head knows; the true one turns its beams.
void ForwardLooking::point_beams(double true_mps, double known_mps, std::vector<float>& sin_beams) const {
  const double turned = true_mps / known_mps;
  sin_beams.clear();
  for (const float angle : beam_angle_rad_) {
    sin_beams.push_back(static_cast<float>(std::clamp(turned * std::sin(static_cast<double>(angle)), -1.0, 1.0)));
  }
}

msg::Ping ForwardLooking::ping_message(const PingEvent& event, const SentPing& sent, const Design& design,
                                       const echo::Image& image) const {
  const HeadSettings& settings = sent.sectors.front().settings;
  const RangedPulse& ranged = design.ranged;
  msg::Ping ping = ensonify::ping_message(event, kComponent, config_.frequency_hz, settings, sent.sound_speed_mps);
  ping.beam_angle_rad = msg::Array<float>::of(beam_angle_rad_);
  write_samples(tvg_of(settings, sent.sound_speed_mps), config_.converter_in_use(), ranged.sampling, image, ping);
  fill_shape(config_.pulse.chirp, config_.pulse.tapered_fraction, ping.applied);
  ping.applied.pulse_length_s = ranged.length_s;
  ping.applied.bandwidth_hz = config_.pulse.chirp ? ranged.band_hz : 0.0;
  ping.applied.transmit_beamwidth_rad = config_.transmit_vertical_rad;
  ping.applied.receive_beamwidth_rad = config_.beamwidth_rad;
  return ping;
}

}  // namespace ensonify
