#include "examples/profiler/head.h"

#include <cmath>
#include <memory>

#include "components/sonar/head_motion.h"
#include "components/sonar/sea_acoustics.h"
#include "kernels/acoustics/array/line.h"

namespace ensonify {
namespace {

constexpr double kSamplesPerPulse = 4.0;
constexpr double kStandsOut_db = 15.0;
constexpr double kReach = 2.0;  // half-power widths from the axis beyond which nothing is sent: -48 dB one-way

/// Amplitude of a Gaussian beam: half the power at half the width, no side lobes.
array::Pattern gaussian_beam(double beamwidth_rad) {
  const double half_power = std::sin(0.5 * beamwidth_rad);
  return array::Pattern().times(array::GaussianFactor{0.5 * std::log(2.0) / (half_power * half_power)});
}

double resolution_m(const ProfilerConfig& c) { return 0.5 * c.sound_speed_mps * c.pulse_length_s; }

Apertures aperture_of(const ProfilerConfig& c) {
  Apertures aperture;
  aperture.frequency_hz = c.frequency_hz;
  aperture.patterns.transmit = aperture.patterns.receive = {gaussian_beam(c.beamwidth_rad)};
  const double size_in_waves = array::length_in_waves_for(c.beamwidth_rad);
  aperture.directivity_index_db = array::directivity_index_db(size_in_waves, size_in_waves);
  aperture.narrowest_rad = c.beamwidth_rad;
  aperture.nearest_m = 1.0;
  aperture.resolution_m = resolution_m(c);
  aperture.seed = c.world->seed;
  aperture.process = c.process;
  return aperture;
}

trace::RayDistribution rays_of(const ProfilerConfig& c) {
  const double reach_rad = kReach * c.beamwidth_rad, reach = std::sin(reach_rad), main = std::sin(c.beamwidth_rad);
  const trace::TransmitVolume cone{trace::TransmitVolume::Axis::kForward,
                                   {-reach, reach, -main, main, main},
                                   {-reach_rad, reach_rad, -c.beamwidth_rad, c.beamwidth_rad, c.beamwidth_rad}};
  return {cone, c.quality.ray_settings(resolution_m(c), c.most_rays), {c.world->seed, c.process + "/rays"}};
}

}  // namespace

HeadPlan Profiler::plan(const Config& config) {
  return {.channels = {{"", config.start(), config.limits(), {{config.frequency_hz}}}},
          .longest_reception_s = config.reception_s(config.range_m),
          .finest_beam_rad = config.beamwidth_rad};
}

Profiler::Profiler(const Config& config, std::size_t)
    : config_(config),
      echoes_(aperture_of(config), std::make_shared<const Environment>(*config.world, config.frequency_hz),
              config.effects, config.quality) {}

HeadOutputs<msg::Ping, msg::BottomTrack> Profiler::outputs() const {
  const double samples = kSamplesPerPulse * config_.reception_s(config_.range_m) / config_.pulse_length_s;
  return {{"ping", sizeof(float) * static_cast<std::size_t>(samples) + 65536}, {"bottom"}};
}

SentPing Profiler::transmit(SimTime, const HeadSettings& settings, const Surroundings&) const {
  const SimTime reception = from_seconds(config_.reception_s(settings.range_m));
  return {{{config_.frequency_hz, config_.pulse_length_s, reception, settings}}};
}

Profiler::Design Profiler::prepare(const HeadSettings& settings) const {
  const double period_s = config_.pulse_length_s / kSamplesPerPulse;
  const double reception_s = seconds(from_seconds(config_.reception_s(settings.range_m)));
  return {settings.range_m,
          {0.0, period_s, static_cast<int>(std::ceil(reception_s / period_s))},
          {echo::tapered_pulse(config_.pulse_length_s, 0.0), period_s, echoes_.cells(), rays_of(config_)}};
}

Profiler::Report Profiler::ping(const PingEvent& event, const SentPing& sent, const Surroundings& around) {
  const Transmission& transmission = sent.sectors.front();
  const HeadSettings& settings = transmission.settings;
  const Design& design = design_of(*this, settings, memory_.design);
  const SeaAcoustics& sea = echoes_.sea();
  head_poses(around.truth, config_.mounting.actual, event.transmit, transmission.reception, memory_.poses);
  const Shot shot{memory_.poses, seconds(event.transmit), settings.source_level_db, echoes_.transmit()};

  const trace::Mesh mesh = sea.mesh(shot, around.seabed, design.shot.rays, event.range_m);
  const Insonified insonified =
      sea.insonify(shot, mesh, design.shot.rays, design.shot.cells, event.range_m, memory_.shot);
  const Echoed echoed = sea.echoes(shot, insonified, memory_.shot);
  const echo::Arrivals& foreign = sea.interference(shot, echoed, event.interfering, design.shot.pulse, memory_.shot);
  const echo::Image& image =
      echoes_.beamform(shot, echoed, design.shot, {event.number(), design.sampling, foreign}, memory_.beams);
  const msg::BottomTrack bottom = detect(event, design, image);

  return {.messages = {ping_message(event, settings, design, image), bottom},
          .trouble = no_echo_reason(echoed.summary(shot, event.range_m, around.seabed))};
}

/// The bottom by the middle of the strongest echo, if it stands out: the strongest of 10,000 samples of noise is 10 dB
/// above their mean.
msg::BottomTrack Profiler::detect(const PingEvent& event, const Design& design, const echo::Image& image) const {
  const auto samples = image.row(0);
  double sum_upa2 = 0.0, most_upa2 = 0.0;
  std::size_t strongest = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const auto power_upa2 = static_cast<double>(std::norm(samples[k]));
    sum_upa2 += power_upa2;
    if (power_upa2 <= most_upa2) continue;
    most_upa2 = power_upa2;
    strongest = k;
  }
  msg::BottomTrack bottom;
  bottom.stamp_ns = event.transmit.count();
  bottom.ping = event.ping;
  bottom.sound_speed_mps = config_.sound_speed_mps;
  if (sum_upa2 == 0.0) return bottom;
  bottom.quality_db = 10.0 * std::log10(most_upa2 * static_cast<double>(samples.size()) / sum_upa2);
  bottom.valid = bottom.quality_db > kStandsOut_db;
  bottom.travel_time_s = design.sampling.start_s + static_cast<double>(strongest) * design.sampling.period_s -
                         0.5 * design.shot.pulse.duration_s;
  bottom.altitude_m = 0.5 * config_.sound_speed_mps * bottom.travel_time_s;
  return bottom;
}

msg::Ping Profiler::ping_message(const PingEvent& event, const HeadSettings& settings, const Design& design,
                                 const echo::Image& image) const {
  msg::Ping ping = ensonify::ping_message(event, kComponent, config_.frequency_hz, settings, config_.sound_speed_mps);
  ping.beam_angle_rad = msg::Array<float>::of({0.0F});
  ping.applied.pulse = "cw";
  ping.applied.transmit_beamwidth_rad = ping.applied.receive_beamwidth_rad = config_.beamwidth_rad;
  write_samples(tvg_of(settings, config_.sound_speed_mps), config_.converter_in_use(), design.sampling, image, ping);
  return ping;
}

}  // namespace ensonify
