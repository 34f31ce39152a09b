#include "components/forward_looking/node.h"

namespace ensonify {

ForwardLookingNode::ForwardLookingNode(const Config& config, Ports& ports)
    : config_(config),
      head_(config),
      channel_(
          config,
          {.longest_listening_s = longest_listening_s(config.pulse, config.longest_range_m, config.sound_speed_mps),
           .max_ping_bytes = head_.max_ping_bytes(),
           .finest_beam_rad = config.beamwidth_rad,
           .probe = true},
          ports) {
  ports.note("near_field_m", head_.near_field_m());
}

SimTime ForwardLookingNode::step(SimTime now) {
  const auto send = [this](const HeadSettings& settings) -> Transmission {
    const RangedPulse pulse = head_.pulse_for(settings);
    return {config_.frequency_hz, pulse.length_s, from_seconds(pulse.listening_s()), settings,
            config_.pulse.chirp ? pulse.band_hz : 0.0};
  };
  const auto listen = [this](const PingUnderWay& ping, const HeadSettings& settings) -> SingleChannel::Heard {
    msg::Ping image = head_.listen(ping.shot(), settings, ping.sound_speed_mps, channel_.truth(), channel_.seabed());
    return {std::move(image), why_black(head_.sight())};
  };
  return channel_.step(now, send, listen);
}

}  // namespace ensonify
