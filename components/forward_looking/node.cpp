#include "components/forward_looking/node.h"

namespace ensonify {

ForwardLookingNode::ForwardLookingNode(const Config& config, Ports& ports)
    : config_(config),
      head_(config),
      channel_(
          config,
          {.longest_reception_s = longest_reception_s(config.pulse, config.longest_range_m, config.sound_speed_mps),
           .max_ping_bytes = head_.max_ping_bytes(),
           .finest_beam_rad = config.beamwidth_rad,
           .probe = true},
          ports) {
  ports.note("near_field_m", head_.near_field_m());
}

SimTime ForwardLookingNode::step(SimTime now) {
  const auto send = [this](const HeadSettings& settings) -> Transmission {
    const RangedPulse pulse = head_.pulse_for(settings);
    return {config_.frequency_hz, pulse.length_s, from_seconds(pulse.reception_s()), settings,
            config_.pulse.chirp ? pulse.band_hz : 0.0};
  };
  const auto receive_echoes = [this](const PingUnderWay& ping,
                                     const HeadSettings& settings) -> SingleChannel::Received {
    msg::Ping image =
        head_.receive_echoes(ping.event(), settings, ping.sound_speed_mps, channel_.truth(), channel_.seabed());
    return {std::move(image), no_echo_reason(head_.trace_summary())};
  };
  return channel_.step(now, send, receive_echoes);
}

}  // namespace ensonify
