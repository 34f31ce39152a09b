#include "components/scanning/node.h"

namespace ensonify {
namespace {

HeadInputs::Start start_of(const ScanningConfig& config, const ScanningHead& head) {
  HeadInputs::Start start;
  start.mounting = config.mounting;
  start.lod = config.lod;
  start.longest_ping = from_seconds(head.pulse_for(config.longest_range_m).listening_s() + config.processing_latency_s);
  start.sound_speed_mps = config.sound_speed_mps;
  start.probe = true;
  start.channels = {{"", config.start(), config.limits()}};
  return start;
}

}  // namespace

ScanningNode::ScanningNode(const Config& config, Ports& ports)
    : frequency_hz_(config.frequency_hz),
      head_(config),
      inputs_(ports, start_of(config, head_)),
      cycle_(ports, inputs_, config.timing()),
      ping_out_(ports.out<msg::Ping>("ping", {.max_bytes = head_.max_ping_bytes(), .rate = config.timing().rate})) {
  ports.note("finest_beam_rad", config.horizontal_beamwidth_rad);
}

SimTime ScanningNode::step(SimTime now) {
  while (const auto ping = cycle_.ready(now)) publish(*ping);
  if (cycle_.may_transmit(now)) transmit(now);
  return cycle_.next();
}

void ScanningNode::transmit(SimTime now) {
  const HeadSettings& settings = inputs_.settings_at_ping();
  const RangedPulse pulse = head_.pulse_for(settings.range_m);
  cycle_.transmit(now, {{frequency_hz_, pulse.length_s, from_seconds(pulse.listening_s()), settings}});
}

void ScanningNode::publish(const PingUnderWay& ping) {
  const Transmission& sent = ping.channels.front();
  msg::Ping row = head_.listen(ping.shot(), sent.settings, ping.sound_speed_mps, inputs_.truth(), inputs_.seabed());
  inputs_.fill_track(row.track, ping.transmit, sent.listening);
  ping_out_.send(row);
  cycle_.published(why_black(head_.sight()));
}

}  // namespace ensonify
