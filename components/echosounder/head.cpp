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
  const double error = c.quality.pattern_error();
  const auto end = static_cast<float>(c.effects.side_lobes ? 2.0 : (round ? 1.2197 : 1.0) / size);
  if (round) {
    pattern.times(
        array::PistonFactor{std::make_shared<array::PatternTable>(
                                [=](double sine) { return array::piston_amplitude(size, sine); }, 0.5 * size, error),
                            end});
  } else {
    const auto table = array::uniform_line_table(size, error);
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
  a.drawn_seed = config.drawn_seed();
  a.process = config.process;
  return a;
}

trace::RayDistribution rays_of(const EchosounderConfig& c) {
  const double first_null = std::min(1.0, (circular(c) ? 1.2197 : 1.0) / size_in_waves(c));
  const double null_rad = std::min(kWidest_rad, std::asin(first_null));
  const trace::TransmitVolume volume{trace::TransmitVolume::Axis::kForward,
                                     {-1.0, 1.0, -first_null, first_null, 2.0 * std::sin(0.5 * c.beamwidth_rad)},
                                     {-kWidest_rad, kWidest_rad, -null_rad, null_rad, c.beamwidth_rad}};
  return {volume, c.quality.ray_settings(range_resolution_m(c), c.most_rays), {c.world->seed, c.process + "/rays"}};
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

HeadPlan Echosounder::plan(const Config& config) {
  HeadSettings longest = config.start();
  longest.pulse_length_s = config.limits()["pulse_length_s"].most;
  return {.channels = {{"", config.start(), config.limits(), {{config.frequency_hz}}}},
          .longest_reception_s = config.reception_s(longest),
          .finest_beam_rad = config.beamwidth_rad};
}

Echosounder::Echosounder(const Config& config, std::size_t)
    : config_(config),
      echoes_(apertures_of(config), std::make_shared<const Environment>(*config.world, config.frequency_hz),
              config.effects, config.quality),
      bottom_(bottom_of(config)) {}

HeadOutputs<msg::Ping, msg::BottomTrack> Echosounder::outputs() const {
  const double samples = plan(config_).longest_reception_s / config_.sample_period_s();
  return {{"ping", sizeof(float) * static_cast<std::size_t>(samples + 2.0) + 65536}, {"bottom"}};
}

SentPing Echosounder::transmit(SimTime, const HeadSettings& settings, const Surroundings&) const {
  return {{{config_.frequency_hz, settings.pulse_length_s, from_seconds(config_.reception_s(settings)), settings}}};
}

Echosounder::Design Echosounder::prepare(const HeadSettings& settings) const {
  const double period_s = config_.sample_period_s();
  return {settings.range_m,
          settings.pulse_length_s,
          {0.0, period_s, static_cast<int>(std::ceil(config_.reception_s(settings) / period_s))},
          {echo::tapered_pulse(settings.pulse_length_s, config_.tapered_fraction), period_s, echoes_.cells(),
           rays_of(config_)}};
}

Echosounder::Report Echosounder::ping(const PingEvent& event, const SentPing& sent, const Surroundings& around) {
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
  const std::string trouble = bottom.valid ? "" : "no echo stands out of the water column: no depth";
  return {{ping_message(event, settings, design, image), std::move(bottom)}, echoed.rays_that_hit > 0, trouble};
}

msg::Ping Echosounder::ping_message(const PingEvent& event, const HeadSettings& settings, const Design& design,
                                    const echo::Image& image) const {
  msg::Ping ping = ensonify::ping_message(event, kComponent, config_.frequency_hz, settings, config_.sound_speed_mps);
  ping.beam_angle_rad = msg::Array<float>::of({0.0F});
  fill_shape(false, config_.tapered_fraction, ping.applied);
  ping.applied.transmit_beamwidth_rad = ping.applied.receive_beamwidth_rad = config_.beamwidth_rad;
  write_samples(tvg_of(settings, config_.sound_speed_mps), config_.converter_in_use(), design.sampling, image, ping);
  return ping;
}

}  // namespace ensonify
