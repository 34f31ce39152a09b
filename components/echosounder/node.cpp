#include "components/echosounder/node.h"

#include <fmt/format.h>

namespace ensonify {
namespace {

SingleChannel::Plan plan_of(const EchosounderConfig& config) {
  HeadSettings longest = config.start();
  longest.pulse_length_s = config.limits().pulse_length_s->most;
  SingleChannel::Plan plan;
  plan.longest_reception_s = config.reception_s(longest);
  plan.max_ping_bytes =
      sizeof(float) * static_cast<std::size_t>(plan.longest_reception_s / config.sample_period_s() + 2.0) + 65536;
  plan.finest_beam_rad = config.beamwidth_rad;
  return plan;
}

}  // namespace

EchosounderNode::EchosounderNode(const Config& config, Ports& ports)
    : config_(config),
      head_(config),
      channel_(config, plan_of(config), ports),
      bottom_out_(ports.out<msg::BottomTrack>("bottom", {.rate = config.timing().rate})) {}

SimTime EchosounderNode::step(SimTime now) {
  const auto send = [this](const HeadSettings& settings) -> Transmission {
    return {config_.frequency_hz, settings.pulse_length_s, from_seconds(config_.reception_s(settings)), settings};
  };
  const auto receive_echoes = [this](const PingUnderWay& ping,
                                     const HeadSettings& settings) -> SingleChannel::Received {
    auto received = head_.receive_echoes(ping.event(), settings, channel_.truth(), channel_.seabed());
    bottom_out_.send(received.bottom);
    std::string trouble;
    if (head_.rays_that_hit() == 0) {
      trouble = fmt::format(
          "no seabed within the range of {:.0f} m: the range is below the altitude, or the terrain has a hole here",
          settings.range_m);
    } else if (!received.bottom.valid) {
      trouble = "no echo stands out of the water column: no depth";
    }
    return {std::move(received.ping), trouble};
  };
  return channel_.step(now, send, receive_echoes);
}

}  // namespace ensonify
