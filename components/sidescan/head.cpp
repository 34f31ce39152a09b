#include "components/sidescan/head.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "components/sonar/head_motion.h"
#include "components/sonar/ranged_pulse.h"
#include "kernels/acoustics/array/aperture.h"
#include "kernels/acoustics/array/line.h"

namespace ensonify {
namespace {

constexpr double kFarthest_rad = 1.75;  // of rays from the head's down axis: a little above the horizon
constexpr double kReach = 8.0;          // sines in which rays are sent, in lambda / L of a uniform line as wide
constexpr double kShadow = 1.0;  // the same, in sqrt(lambda / L): L / 2R where Fresnel's approximation ends is 0.81
constexpr double kNothingBehind_db = std::numeric_limits<double>::infinity();

double face_in_waves(const SidescanChannel& c) { return array::length_in_waves_for(c.vertical_beamwidth_rad); }

double wavelength_m(const SidescanConfig& config, const SidescanChannel& c) {
  return config.sound_speed_mps / c.frequency_hz;
}

/// A side's line, in wavelengths.
LineDesign line_of(const SidescanConfig& config, const SidescanChannel& c) {
  return {c.horizontal_beamwidth_rad, 1.0, c.shading, config.quality.pattern_error()};
}

/// Along the track: the far field of the line as it is shaded, or the near field of a uniform one, focused so.
array::Pattern along_track(const SidescanConfig& config, const SidescanChannel& c, const LineDesign& line,
                           array::NearFieldFactor::Focus focus) {
  const bool side_lobes = config.effects.side_lobes;
  if (c.focus == Focus::kIdeal) {
    const auto end = static_cast<float>(side_lobes ? 2.0 : line.first_null);
    return array::Pattern().times(array::LineFactor{.table = line.pattern, .end = end});
  }
  const double wave_m = wavelength_m(config, c);
  return array::Pattern().times(
      array::NearFieldFactor{line.uniform_in_waves * wave_m, wave_m, focus, c.focus_m, side_lobes});
}

array::NearFieldFactor::Focus received_focus(const SidescanChannel& c) {
  using Focused = array::NearFieldFactor::Focus;
  if (c.focus == Focus::kEcho) return Focused::kEcho;
  return c.focus == Focus::kFixed ? Focused::kFixed : Focused::kOff;
}

/// Both sides of a head whose lines have this pattern.
std::vector<array::Pattern> sides_of(const array::Pattern& along, const SidescanConfig& config,
                                     const SidescanChannel& channel) {
  const auto across = array::uniform_line_table(face_in_waves(channel), config.quality.pattern_error());
  const auto cosine = static_cast<float>(std::cos(channel.depression_rad));
  const auto sine = static_cast<float>(std::sin(channel.depression_rad));
  std::vector<array::Pattern> sides;
  for (const float side : {-1.0F, 1.0F}) {
    array::Pattern& pattern = sides.emplace_back(along);
    if (!config.effects.directivity) {  // each side receives its own half of the water
      pattern.times(array::FaceFactor{{0.0F, side, 0.0F}, array::Face(0.0, kNothingBehind_db)});
      continue;
    }
    const Eigen::Vector3f normal(0.0F, side * cosine, sine), up_the_face(0.0F, -side * sine, cosine);
    pattern.times(array::LineFactor{.table = across, .axis_head = up_the_face})
        .times(array::FaceFactor{normal, array::Face(0.0, channel.back_loss_db)});
  }
  return sides;
}

AperturePatterns patterns_of(const SidescanConfig& config, const SidescanChannel& channel, const LineDesign& line) {
  const auto sides = [&](array::NearFieldFactor::Focus focus) {
    return sides_of(along_track(config, channel, line, focus), config, channel);
  };
  return {sides(array::NearFieldFactor::Focus::kOff), sides(received_focus(channel))};
}

ApertureEchoes echoes_of(const SidescanConfig& config, const SidescanChannel& channel, const LineDesign& line,
                         const Effects& effects) {
  Apertures a;
  a.frequency_hz = channel.frequency_hz;
  a.patterns = patterns_of(config, channel, line);
  a.directivity_index_db = array::directivity_index_db(line.effective_in_waves, face_in_waves(channel));
  a.electronic_noise_db = channel.electronic_noise_db;
  a.narrowest_rad = channel.horizontal_beamwidth_rad;
  a.resolution_m = channel.resolution_m(config.sound_speed_mps);
  a.seed = config.world->seed;
  a.drawn_seed = config.drawn_seed();
  a.process = config.process;
  return {a, std::make_shared<const Environment>(*config.world, channel.frequency_hz), effects, config.quality};
}

/// To both sides. Across-track only range distinguishes echoes.
trace::RayDistribution rays_of(const SidescanConfig& config, const SidescanChannel& channel, const LineDesign& line) {
  const double wave_over_length = 1.0 / line.uniform_in_waves, null = line.first_null;
  double reach = std::min(1.0, kReach * wave_over_length);
  if (channel.focus != Focus::kIdeal) reach = std::max(reach, std::min(1.0, kShadow * std::sqrt(wave_over_length)));
  const trace::TransmitVolume volume{
      trace::TransmitVolume::Axis::kForward,
      {-reach, reach, -null, null, channel.horizontal_beamwidth_rad},
      {-kFarthest_rad, kFarthest_rad, -kFarthest_rad, kFarthest_rad, channel.vertical_beamwidth_rad}};
  // Below the head a cell of directions holds few ranges, and what few rays leave of their level would be a stripe
  // along the track. Those to places of the world leave it at other ranges in each ping.
  trace::RaySettings rays = config.quality.ray_settings(channel.resolution_m(config.sound_speed_mps), config.most_rays);
  rays.fewest_in_main_cell = trace::RaySettings::kToPlaces;
  return {volume, rays, {config.world->seed, config.process + "/" + channel.name + "/rays"}};
}

/// Both sides to their first nulls along the track.
LabelView label_view_of(const LineDesign& line, std::span<const array::Pattern> receive) {
  LabelView view;
  view.axes = {Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitZ(), Eigen::Vector3f::UnitY()};
  view.sectors = {{-kFarthest_rad, 0.0, &receive[0]}, {0.0, kFarthest_rad, &receive[1]}};
  view.lobe = aperture_lobe(line);
  return view;
}

detect::FirstBottomSettings bottom_of(const SidescanConfig& config) {
  detect::FirstBottomSettings settings;
  settings.threshold_db = config.bottom_threshold_db;
  return settings;
}

}  // namespace

AperturePatterns side_patterns(const SidescanConfig& config, const SidescanChannel& channel) {
  return patterns_of(config, channel, line_of(config, channel));
}

HeadPlan Sidescan::plan(const Config& config) {
  HeadPlan plan;
  plan.finest_beam_rad = 1.0;
  for (const SidescanChannel& channel : config.channels) {
    const SettingLimits limits = config.limits_of(channel);
    plan.channels.push_back({channel.name, config.start_of(channel), limits, {{channel.frequency_hz}}});
    plan.longest_reception_s =
        std::max(plan.longest_reception_s, config.reception_s(channel.range_m, limits.find("pulse_length_s")->most));
    plan.finest_beam_rad = std::min(plan.finest_beam_rad, channel.horizontal_beamwidth_rad);
  }
  return plan;
}

Sidescan::Sidescan(const Config& config, std::size_t channel)
    : Sidescan(config, config.channels[channel], line_of(config, config.channels[channel])) {}

Sidescan::Sidescan(const Config& config, const SidescanChannel& channel, const LineDesign& line)
    : config_(config),
      channel_(channel),
      rays_(rays_of(config, channel, line)),
      echoes_(echoes_of(config, channel, line, config.effects)),
      bottom_(bottom_of(config)),
      label_rows_{aperture_row(line, 0), aperture_row(line, 1)} {
  if (config.labels != LabelKind::kNone) labeller_.emplace(label_view_of(line, echoes_.receive()));
  if (config.labels == LabelKind::kEnergies)
    expectation_.emplace(echoes_of(config, channel, line, without_speckle(config.effects)));
}

HeadOutputs<msg::Ping, msg::BottomTrack, msg::Labels, msg::Energies> Sidescan::outputs() const {
  const double longest_s = config_.reception_s(channel_.range_m, config_.limits_of(channel_)["pulse_length_s"].most);
  const auto samples = static_cast<std::size_t>(longest_s / channel_.sample_period_s() + 2.0);
  const std::size_t bytes = 2 * sizeof(float) * samples + 65536;
  return {{"ping", bytes},
          {"bottom"},
          {"labels", bytes, config_.labels != LabelKind::kNone},
          {"energies", kEnergySources * bytes, config_.labels == LabelKind::kEnergies}};
}

SentPing Sidescan::transmit(SimTime, const HeadSettings& settings, const Surroundings&) const {
  const SimTime reception = from_seconds(config_.reception_s(settings.range_m, settings.pulse_length_s));
  return {{{channel_.frequency_hz, settings.pulse_length_s, reception, settings, channel_.bandwidth_hz}}};
}

Sidescan::Design Sidescan::prepare(const HeadSettings& settings) const {
  const double period_s = channel_.sample_period_s();
  const double reception_s = config_.reception_s(settings.range_m, settings.pulse_length_s);
  return {settings.range_m,
          settings.pulse_length_s,
          {0.0, period_s, static_cast<int>(std::ceil(reception_s / period_s))},
          {channel_.pulse(settings.pulse_length_s), period_s, echoes_.cells(), rays_}};
}

Sidescan::Report Sidescan::ping(const PingEvent& event, const SentPing& sent, const Surroundings& around) {
  const Transmission& transmission = sent.sectors.front();
  const HeadSettings& settings = transmission.settings;
  const Design& design = design_of(*this, settings, memory_.design);
  const SeaAcoustics& sea = echoes_.sea();
  head_poses(around.truth, config_.mounting.actual, event.transmit, transmission.reception, memory_.poses);
  const Shot shot{.poses = memory_.poses,
                  .transmit_s = seconds(event.transmit),
                  .source_level_db = settings.source_level_db,
                  .transmit = echoes_.transmit(),
                  .latest_s = latest_arrival_s(design.sampling, design.shot.pulse)};

  const trace::Mesh mesh = sea.mesh(shot, around.seabed, design.shot.rays, event.range_m);
  const Insonified insonified =
      sea.insonify(shot, mesh, design.shot.rays, design.shot.cells, event.range_m, memory_.shot);
  const Echoed echoed = sea.echoes(shot, insonified, memory_.shot);
  const echo::Arrivals& foreign = sea.interference(shot, echoed, event.interfering, design.shot.pulse, memory_.shot);
  const echo::Image& image =
      echoes_.beamform(shot, echoed, design.shot, {event.number(), design.sampling, foreign}, memory_.beams);
  msg::BottomTrack bottom =
      bottom_.find(image, design.sampling, design.shot.pulse, config_.sound_speed_mps, state_.bottom, memory_.bottom);

  bottom.stamp_ns = event.transmit.count();
  bottom.ping = event.ping;
  std::optional<msg::Labels> labels;
  if (labeller_) {
    const std::vector<float> background =
        echoes_.expected_background_upa2(design.shot.pulse, design.sampling, memory_.beams);
    labels = labeller_->labels(sea, shot, mesh, echoed, design.shot,
                               {event, label_rows_, design.sampling, background, event.range_m}, memory_.shot,
                               memory_.labels);
  }
  std::optional<msg::Energies> energies;
  if (expectation_) {
    const auto receive = [&](const echo::Arrivals& of_others) {
      return ApertureReception{event.number(), design.sampling, of_others};
    };
    energies =
        expectation_->of({event, 2, design.sampling}, shot, mesh, insonified, design.shot, receive, memory_.expected);
  }
  return {{ping_message(event, settings, design, image), std::move(bottom), std::move(labels), std::move(energies)},
          echoed.rays_that_hit > 0};
}

msg::Ping Sidescan::ping_message(const PingEvent& event, const HeadSettings& settings, const Design& design,
                                 const echo::Image& image) const {
  msg::Ping ping = ensonify::ping_message(event, kComponent, channel_.frequency_hz, settings, config_.sound_speed_mps);
  const auto broadside = static_cast<float>(0.5 * std::numbers::pi - channel_.depression_rad);
  ping.beam_angle_rad = msg::Array<float>::of({-broadside, broadside});
  fill_shape(channel_.chirp, channel_.tapered_fraction, ping.applied);
  ping.applied.bandwidth_hz = channel_.bandwidth_hz;
  ping.applied.transmit_beamwidth_rad = channel_.horizontal_beamwidth_rad;
  ping.applied.receive_beamwidth_rad = channel_.vertical_beamwidth_rad;
  write_samples(tvg_of(settings, config_.sound_speed_mps), config_.converter_in_use(), design.sampling, image, ping);
  return ping;
}

}  // namespace ensonify
