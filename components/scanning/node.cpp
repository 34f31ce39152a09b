#include "components/scanning/node.h"

namespace ensonify {

ScanningNode::ScanningNode(const Config& config, Ports& ports)
    : frequency_hz_(config.frequency_hz),
      head_(config),
      channel_(
          config,
          {.longest_reception_s = longest_reception_s(config.pulse, config.longest_range_m, config.sound_speed_mps),
           .max_ping_bytes = head_.max_ping_bytes(),
           .finest_beam_rad = config.horizontal_beamwidth_rad,
           .probe = true},
          ports) {}

SimTime ScanningNode::step(SimTime now) {
  const auto send = [this](const HeadSettings& settings) -> Transmission {
    const RangedPulse pulse = head_.pulse_for(settings);
    return {frequency_hz_, pulse.length_s, from_seconds(pulse.reception_s()), settings};
  };
  const auto receive_echoes = [this](const PingUnderWay& ping,
                                     const HeadSettings& settings) -> SingleChannel::Received {
    msg::Ping row =
        head_.receive_echoes(ping.event(), settings, ping.sound_speed_mps, channel_.truth(), channel_.seabed());
    return {std::move(row), no_echo_reason(head_.trace_summary())};
  };
  return channel_.step(now, send, receive_echoes);
}

}  // namespace ensonify
