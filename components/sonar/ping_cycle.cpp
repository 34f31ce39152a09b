#include "components/sonar/ping_cycle.h"

#include <algorithm>

namespace ensonify {

PingCycle::PingCycle(Ports& ports, const HeadInputs& inputs, const PingTiming& timing)
    : ports_(ports),
      inputs_(inputs),
      processing_latency_(timing.processing_latency),
      clock_(ports, timing),
      others_(ports, inputs, timing.others, timing.processing_latency),
      transmit_out_(ports.out<msg::Transmit>("transmit", {.rate = timing.rate})) {}

std::optional<PingUnderWay> PingCycle::ready(SimTime now) {
  if (under_way_.empty() || under_way_.front().ready > now) return std::nullopt;
  PingUnderWay ping = std::move(under_way_.front());
  under_way_.pop_front();
  ping.interfering = others_.during(ping.transmit, ping.ready - processing_latency_ - ping.transmit);
  return ping;
}

bool PingCycle::may_transmit(SimTime now) {
  if (!clock_.due(now)) return false;
  const std::string obstacle = inputs_.obstacle(now);
  if (obstacle.empty()) return true;
  clock_.skipped();
  ports_.count("pings_skipped");
  ports_.health("degraded", obstacle);
  return false;
}

void PingCycle::transmit(SimTime now, std::vector<Transmission> channels) {
  SimTime reception{0};
  for (const Transmission& channel : channels) reception = std::max(reception, channel.reception);
  clock_.set_rate(rate_of(channels.front().settings.ping_rate_hz));
  clock_.transmitted(now, reception);
  std::vector<const Transmission*> in_time;
  for (const Transmission& channel : channels) in_time.push_back(&channel);
  std::ranges::stable_sort(in_time, {}, [](const Transmission* channel) { return channel->delay; });
  for (const Transmission* sent : in_time) {
    const Transmission& channel = *sent;
    msg::Transmit transmit;
    transmit.stamp_ns = (now + channel.delay).count();
    transmit.ping = pings_;
    transmit.frequency_hz = channel.frequency_hz;
    transmit.pulse_length_s = channel.pulse_length_s;
    transmit.bandwidth_hz = channel.bandwidth_hz;
    transmit.source_level_db = channel.settings.source_level_db;
    transmit.next_ns = clock_.intended().count();
    transmit_out_.send(transmit);
  }
  under_way_.push_back({pings_++, now, std::move(channels), now + reception + processing_latency_});
}

void PingCycle::published(const std::string& trouble) {
  ports_.count("pings");
  if (!trouble.empty()) return ports_.health("degraded", trouble);
  if (inputs_.estimate().empty()) {
    return ports_.health("degraded", "no navigation estimate has arrived: pings have no track");
  }
  ports_.health("ok", "");
}

SimTime PingCycle::next() const {
  return under_way_.empty() ? clock_.next() : std::min(clock_.next(), under_way_.front().ready);
}

}  // namespace ensonify
