#include "components/multibeam/node.h"

#include <algorithm>

#include "components/multibeam/snippets.h"
#include "components/sonar/environment.h"
#include "components/sonar/head_motion.h"

namespace ensonify {
namespace {

HeadInputs::Start start_of(const MultibeamConfig& config) {
  HeadInputs::Start start;
  start.mounting = config.mounting;
  start.tide = config.world.vertical.tide;
  start.lod = config.lod;
  start.lod.adaptations_per_ping = static_cast<std::int32_t>(config.all_sectors().size());
  start.longest_ping = from_seconds(config.longest_reception_s() + config.processing_latency_s);
  start.probe = true;
  start.channels = {{"", config.start(), config.limits()}};
  return start;
}

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

MultibeamNode::MultibeamNode(const Config& config, Ports& ports)
    : config_(config),
      lines_(area_lengths(config, config.frequency_hz)),
      head_(config),
      applied_(applied_profile(config.world)),
      soundings_(config),
      inputs_(ports, start_of(config)),
      cycle_(ports, inputs_, config.timing()),
      range_(config.range_m, 0.5 * config.swath_rad, config.beams),
      swath_of_range_rad_(config.swath_rad),
      heading_(config.heading_mean_s),
      ping_out_(ports.out<msg::Ping>("ping", {.max_bytes = head_.max_ping_bytes(), .rate = config.timing().rate})),
      soundings_out_(ports.out<msg::Soundings>("soundings",
                                               {.max_bytes = soundings_bytes(config), .rate = config.timing().rate})) {
  ports.note("finest_beam_rad", std::min(config.transmit_beamwidth_rad, config.receive_beamwidth_rad));
  const OutOptions snippets{.max_bytes = snippet_bytes(config), .rate = config.timing().rate};
  if (config.snippets) snippets_out_ = ports.out<msg::Snippets>("snippets", snippets);
  if (config.image.published) image_out_ = ports.out<msg::SeabedImage>("seabed_image", snippets);
  ports.in<msg::Attitude>("attitude",
                          [this](const msg::Attitude& sensor) {
                            attitude_ = {sensor.heading_grid_rad, sensor.pitch_rad, sensor.roll_rad};
                            heading_.update(1e-9 * static_cast<double>(sensor.stamp_ns), sensor.heading_grid_rad);
                          },
                          {.delay = from_seconds(config.attitude_latency_s), .optional = true});
}

SimTime MultibeamNode::step(SimTime now) {
  return cycle_.step(
      now, [&] { transmit(now); }, [this](const PingUnderWay& ping) { publish(ping); });
}

void MultibeamNode::transmit(SimTime now) {
  HeadSettings settings = inputs_.settings_at_ping();
  follow_range(settings);
  if (settings.auto_range) settings.range_m = range_.range_m();
  const SimTime reception = from_seconds(config_.reception_s(settings.range_m, settings.pulse_length_s));
  std::vector<Transmission> sectors;
  for (const auto& sector : config_.all_sectors()) {
    sectors.push_back({.frequency_hz = sector.frequency_hz,
                       .pulse_length_s = settings.pulse_length_s,
                       .reception = reception,
                       .settings = settings,
                       .bandwidth_hz = config_.bandwidth_hz,
                       .delay = from_seconds(sector.delay_s)});
  }
  cycle_.transmit(now, std::move(sectors));
  steerings_.push_back(steer(config_, settings.swath_rad, steering_inputs(now)));
}

/// A swath of another width searches for its edges anew.
void MultibeamNode::follow_range(const HeadSettings& settings) {
  if (settings.swath_rad == swath_of_range_rad_) return;
  swath_of_range_rad_ = settings.swath_rad;
  range_ = AutoRange(config_.range_m, 0.5 * settings.swath_rad, config_.beams);
}

/// Until the probe reports, the head takes the applied profile's speed at the depth where it estimates to be.
SteeringInputs MultibeamNode::steering_inputs(SimTime now) const {
  SteeringInputs steering_inputs;
  steering_inputs.vehicle = attitude_;
  steering_inputs.mean_heading_rad = heading_.mean_rad();
  if (const auto probe = inputs_.probe_mps()) {
    steering_inputs.sound_speed_mps = *probe;
    return steering_inputs;
  }
  const auto body = inputs_.estimate().at(now.count(), frames::PoseHistory::Outside::kNearest);
  steering_inputs.sound_speed_mps = applied_.speed_mps(
      body ? -frames::head_pose(*body, config_.mounting.measured).position_enu_m.z() : config_.world.mission.depth_m);
  return steering_inputs;
}

void MultibeamNode::publish(const PingUnderWay& ping) {
  const Steering steering = std::move(steerings_.front());
  steerings_.pop_front();
  const Transmission& sent = ping.channels.front();
  const PingEvent event = ping.event();
  const auto& received = head_.receive_echoes(event, sent.settings, steering, inputs_.truth(), inputs_.seabed());

  const auto every = [&](int n) { return n > 0 && event.ping % n == 0; };
  const bool whole = sent.settings.mode == "water_column", phase = whole || every(config_.phase_every);
  if (phase || every(config_.amplitude_every)) {
    msg::Ping message = head_.ping_message(event, sent.settings, steering, phase);
    inputs_.fill_track(message.track, ping.transmit, sent.reception);
    ping_out_.send(message);
  }
  msg::Soundings soundings = soundings_.make(event, sent.settings, steering, received, inputs_.estimate(),
                                             inputs_.navigation_errors().value_or(config_.uncertainty.unstated()));
  soundings.applied = head_.applied(event, sent.settings, steering);
  inputs_.fill_track(soundings.track, ping.transmit, sent.reception);
  soundings_out_.send(soundings);
  publish_images(sent.settings, steering, received, soundings);
  range_.update(soundings_.bottoms(), event.range_m);
  cycle_.published(trouble(head_.trace_summary(event.range_m, inputs_.seabed())));
}

void MultibeamNode::publish_images(const HeadSettings& settings, const Steering& steering,
                                   const std::vector<MultibeamHead::Received>& received,
                                   const msg::Soundings& soundings) {
  if (!snippets_out_ && !image_out_) return;
  msg::Snippets snippets = snippets_of(received, steering, soundings_.echoes(), soundings);
  snippets.applied = soundings.applied;
  if (snippets_out_) snippets_out_->send(snippets);
  if (!image_out_) return;
  msg::SeabedImage image = seabed_image_of(config_, settings, steering, received.front(), lines_, snippets, soundings);
  image.applied = soundings.applied;
  image_out_->send(image);
}

std::string MultibeamNode::trouble(const TraceSummary& trace_summary) const {
  const std::string why = no_echo_reason(trace_summary);
  if (!why.empty() || inputs_.estimate().empty()) return why;
  return soundings_.bottoms().empty() ? "no beam detects the seabed" : "";
}

}  // namespace ensonify
