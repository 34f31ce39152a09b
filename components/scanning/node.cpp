#include "components/scanning/node.h"

#include <algorithm>

#include "components/runtime/head/head_motion.h"

namespace ensonify {
namespace {

HeadInputs::Start start_of(const ScanningConfig& config, const ScanningHead& head) {
  HeadInputs::Start start;
  start.actual = config.mounting.actual;
  start.keep =
      from_seconds(2.0 * (head.pulse_for(config.longest_range_m).listening_s() + config.processing_latency_s) + 1.0);
  start.sound_speed_mps = config.sound_speed_mps;
  start.settings = config.start();
  start.limits = config.limits();
  return start;
}

}  // namespace

ScanningNode::ScanningNode(const Config& config, Ports& ports)
    : ports_(ports),
      config_(config),
      head_(config),
      inputs_(ports, start_of(config, head_)),
      clock_(config.ping_rate(), from_seconds(config.dead_time_s)),
      ping_out_(ports.out<msg::Ping>("ping", {.max_bytes = head_.max_ping_bytes(), .rate = config.ping_rate()})),
      transmit_out_(ports.out<msg::Transmit>("transmit", {.rate = config.ping_rate()})) {
  ports.note("finest_beam_rad", config.horizontal_beamwidth_rad);
}

SimTime ScanningNode::step(SimTime now) {
  while (!pending_.empty() && pending_.front().ready <= now) {
    receive(pending_.front());
    pending_.pop_front();
  }
  if (clock_.next() <= now) transmit(now);
  return pending_.empty() ? clock_.next() : std::min(clock_.next(), pending_.front().ready);
}

void ScanningNode::transmit(SimTime now) {
  if (const std::string obstacle = inputs_.obstacle(now); !obstacle.empty()) {
    clock_.skipped();
    ports_.count("pings_skipped");
    return ports_.health("degraded", obstacle);
  }
  const HeadSettings& settings = inputs_.settings().at_ping();
  const SimTime listening = from_seconds(head_.pulse_for(settings.range_m).listening_s());
  pending_.push_back({{pings_++, now, settings.range_m},
                      settings,
                      inputs_.sound_speed_mps(),
                      listening,
                      now + listening + from_seconds(config_.processing_latency_s)});
  msg::Transmit transmit;
  transmit.stamp_ns = now.count();
  transmit.ping = pending_.back().shot.ping;
  transmit.frequency_hz = config_.frequency_hz;
  transmit.pulse_length_s = head_.pulse_for(settings.range_m).length_s;
  transmit.source_level_db = settings.source_level_db;
  transmit_out_.send(transmit);
  clock_.set_rate(Config::rate_of(settings.ping_rate_hz));
  clock_.transmitted(listening);
}

void ScanningNode::receive(const Pending& pending) {
  msg::Ping ping =
      head_.listen(pending.shot, pending.settings, pending.sound_speed_mps, inputs_.truth(), inputs_.seabed());
  fill(ping.track, inputs_.estimate(), config_.mounting.measured, pending.shot.transmit, pending.listening);
  ping_out_.send(ping);
  ports_.count("pings");
  if (const std::string why = why_black(head_.sight()); !why.empty()) return ports_.health("degraded", why);
  if (inputs_.estimate().empty()) {
    return ports_.health("degraded", "no navigation estimate has arrived: pings have no track");
  }
  ports_.health("ok", "");
}

}  // namespace ensonify
