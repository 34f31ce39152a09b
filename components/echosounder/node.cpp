#include "components/echosounder/node.h"

#include <fmt/format.h>

namespace ensonify {
namespace {

/// With the longest range and pulse that can be set.
double longest_listening_s(const EchosounderConfig& config) {
  HeadSettings longest = config.start();
  longest.pulse_length_s = config.limits().pulse_length_s->most;
  return config.listening_s(longest);
}

std::size_t ping_bytes(const EchosounderConfig& config) {
  return sizeof(float) * static_cast<std::size_t>(longest_listening_s(config) / config.sample_period_s() + 2.0) + 65536;
}

HeadInputs::Start start_of(const EchosounderConfig& config) {
  HeadInputs::Start start;
  start.mounting = config.mounting;
  start.lod = config.lod;
  start.longest_ping = from_seconds(longest_listening_s(config) + config.processing_latency_s);
  start.sound_speed_mps = config.sound_speed_mps;
  start.channels = {{"", config.start(), config.limits()}};
  return start;
}

}  // namespace

EchosounderNode::EchosounderNode(const Config& config, Ports& ports)
    : config_(config),
      head_(config),
      inputs_(ports, start_of(config)),
      cycle_(ports, inputs_, config.timing()),
      ping_out_(ports.out<msg::Ping>("ping", {.max_bytes = ping_bytes(config), .rate = config.timing().rate})),
      bottom_out_(ports.out<msg::BottomTrack>("bottom", {.rate = config.timing().rate})) {
  ports.note("finest_beam_rad", config.beamwidth_rad);
}

SimTime EchosounderNode::step(SimTime now) {
  while (const auto ping = cycle_.ready(now)) publish(*ping);
  if (cycle_.may_transmit(now)) transmit(now);
  return cycle_.next();
}

void EchosounderNode::transmit(SimTime now) {
  const HeadSettings& settings = inputs_.settings_at_ping();
  cycle_.transmit(
      now, {{config_.frequency_hz, settings.pulse_length_s, from_seconds(config_.listening_s(settings)), settings}});
}

void EchosounderNode::publish(const PingUnderWay& ping) {
  const Transmission& sent = ping.channels.front();
  auto heard = head_.listen(ping.shot(), sent.settings, inputs_.truth(), inputs_.seabed());
  inputs_.fill_track(heard.ping.track, ping.transmit, sent.listening);
  ping_out_.send(heard.ping);
  bottom_out_.send(heard.bottom);
  std::string trouble;
  if (head_.rays_that_hit() == 0) {
    trouble = fmt::format(
        "no seabed within the range of {:.0f} m: the range is below the altitude, or the terrain has a hole here",
        sent.settings.range_m);
  } else if (!heard.bottom.valid) {
    trouble = "no echo stands out of the water column: no depth";
  }
  cycle_.published(trouble);
}

}  // namespace ensonify
