#include "components/multibeam/node.h"

#include <algorithm>

#include "components/multibeam/snippets.h"
#include "components/sonar/environment.h"
#include "components/sonar/head_motion.h"

namespace ensonify {
namespace {

std::size_t most_entries(const MultibeamConfig& config) {
  const Steering steering = steer(config, config.swath_rad, {});
  return steering.sin_soundings.size() * static_cast<std::size_t>(config.detections_per_beam);
}

std::size_t soundings_bytes(const MultibeamConfig& config) {
  const auto poses = static_cast<std::size_t>(config.longest_reception_s() / seconds(kTrackPeriod)) + 3;  // 8 numbers
  return most_entries(config) * 88 + poses * 64 + 8192;
}

/// Every sample of every entry's beam, at worst.
std::size_t snippet_bytes(const MultibeamConfig& config) {
  return most_entries(config) * (static_cast<std::size_t>(config.most_samples()) * sizeof(float) + 32) + 8192;
}

}  // namespace

HeadPlan Multibeam::plan(const Config& config) {
  return {.channels = {{"", config.start(), config.limits()}},
          .sectors = static_cast<int>(config.all_sectors().size()),
          .longest_reception_s = config.longest_reception_s(),
          .finest_beam_rad = std::min(config.transmit_beamwidth_rad, config.receive_beamwidth_rad),
          .probe = true};
}

Multibeam::Multibeam(const Config& config, std::size_t)
    : config_(config),
      head_(config),
      applied_(applied_profile(*config.world)),
      soundings_(config, head_.design()),
      range_(config.range_m, 0.5 * config.swath_rad, config.beams),
      swath_of_range_rad_(config.swath_rad),
      heading_(config.heading_mean_s) {}

HeadOutputs<msg::Ping, msg::Soundings, msg::Snippets, msg::SeabedImage> Multibeam::outputs() const {
  const std::size_t image_bytes = snippet_bytes(config_);
  return {{"ping", head_.max_ping_bytes()},
          {"soundings", soundings_bytes(config_)},
          {"snippets", image_bytes, config_.snippets},
          {"seabed_image", image_bytes, config_.image.published}};
}

void Multibeam::connect(Ports& ports) {
  ports.in<msg::Attitude>("attitude",
                          [this](const msg::Attitude& sensor) {
                            attitude_ = {sensor.heading_grid_rad, sensor.pitch_rad, sensor.roll_rad};
                            heading_.update(1e-9 * static_cast<double>(sensor.stamp_ns), sensor.heading_grid_rad);
                          },
                          {.delay = from_seconds(config_.attitude_latency_s), .optional = true});
}

Multibeam::Sent Multibeam::transmit(SimTime now, HeadSettings settings, const HeadInputs& inputs) {
  follow_range(settings);
  if (settings.auto_range) settings.range_m = range_.range_m();
  const SimTime reception = from_seconds(config_.reception_s(settings.range_m, settings.pulse_length_s));
  Sent sent;
  for (const auto& sector : config_.all_sectors()) {
    sent.sectors.push_back({.frequency_hz = sector.frequency_hz,
                            .pulse_length_s = settings.pulse_length_s,
                            .reception = reception,
                            .settings = settings,
                            .bandwidth_hz = config_.bandwidth_hz,
                            .delay = from_seconds(sector.delay_s)});
  }
  sent.steering = steer(config_, settings.swath_rad, steering_inputs(now, inputs));
  return sent;
}

/// A swath of another width searches for its edges anew.
void Multibeam::follow_range(const HeadSettings& settings) {
  if (settings.swath_rad == swath_of_range_rad_) return;
  swath_of_range_rad_ = settings.swath_rad;
  range_ = AutoRange(config_.range_m, 0.5 * settings.swath_rad, config_.beams);
}

/// Until the probe reports, the head takes the applied profile's speed at the depth where it estimates to be.
SteeringInputs Multibeam::steering_inputs(SimTime now, const HeadInputs& inputs) const {
  SteeringInputs steering_inputs;
  steering_inputs.vehicle = attitude_;
  steering_inputs.mean_heading_rad = heading_.mean_rad();
  if (const auto probe = inputs.probe_mps()) {
    steering_inputs.sound_speed_mps = *probe;
    return steering_inputs;
  }
  const auto body = inputs.estimate().at(now.count(), frames::PoseHistory::Outside::kNearest);
  steering_inputs.sound_speed_mps = applied_.speed_mps(
      body ? -frames::head_pose(*body, config_.mounting.measured).position_enu_m.z() : config_.world->mission.depth_m);
  return steering_inputs;
}

Multibeam::Report Multibeam::ping(const PingEvent& event, const Sent& sent, HeadInputs& inputs) {
  const HeadSettings& settings = sent.sectors.front().settings;
  head_.receive_echoes(event, settings, sent.steering, inputs.truth(), inputs.seabed(), received_);

  Report report;
  const auto every = [&](int n) { return n > 0 && event.ping % n == 0; };
  const bool whole = settings.mode == "water_column", phase = whole || every(config_.phase_every);
  if (phase || every(config_.amplitude_every)) {
    std::get<0>(report.messages) = head_.ping_message(received_, event, settings, sent.steering, phase);
  }
  const uncertainty::Navigation navigation = inputs.navigation_errors().value_or(config_.uncertainty.unstated());
  const InstrumentPing known{event, settings, sent.steering, inputs.estimate(), navigation};
  Placed placed =
      soundings_.place(known, soundings_.detect(known, received_.sectors, sounding_memory_), relief_, sounding_memory_);
  placed.soundings.applied = head_.applied(event, settings, sent.steering);
  add_images(sent, placed, report);
  range_.update(placed.bottoms, event.range_m);
  report.trouble = no_echo_reason(received_.trace);
  if (report.trouble.empty() && !inputs.estimate().empty() && placed.bottoms.empty())
    report.trouble = "no beam detects the seabed";
  std::get<1>(report.messages) = std::move(placed.soundings);
  return report;
}

void Multibeam::add_images(const Sent& sent, const Placed& placed, Report& report) const {
  if (!config_.snippets && !config_.image.published) return;
  auto& snippets = std::get<2>(report.messages);
  auto& image = std::get<3>(report.messages);
  snippets = snippets_of(received_.sectors, sent.steering, placed.echoes, placed.soundings);
  snippets->applied = placed.soundings.applied;
  if (!config_.image.published) return;
  image = seabed_image_of(config_, sent.sectors.front().settings, sent.steering, received_.sectors.front(),
                          head_.design().area, *snippets, placed.soundings);
  image->applied = placed.soundings.applied;
}

}  // namespace ensonify
