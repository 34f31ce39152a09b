#include "components/sidescan/node.h"

#include <algorithm>

namespace ensonify {

HeadPlan Sidescan::plan(const Config& config) {
  HeadPlan plan;
  plan.finest_beam_rad = 1.0;
  for (const SidescanChannel& channel : config.channels) {
    const SettingLimits limits = config.limits_of(channel);
    plan.channels.push_back({channel.name, config.start_of(channel), limits, {{channel.frequency_hz}}});
    plan.longest_reception_s =
        std::max(plan.longest_reception_s, config.reception_s(channel.range_m, limits.find("pulse_length_s")->most));
    plan.finest_beam_rad = std::min(plan.finest_beam_rad, channel.horizontal_beamwidth_rad);
  }
  return plan;
}

SentPing Sidescan::transmit(SimTime, const HeadSettings& settings, const HeadInputs&) const {
  const SimTime reception = from_seconds(config_.reception_s(settings.range_m, settings.pulse_length_s));
  return {{{channel_.frequency_hz, settings.pulse_length_s, reception, settings, channel_.bandwidth_hz}}};
}

HeadReport<msg::Ping, msg::BottomTrack> Sidescan::ping(const PingEvent& event, const SentPing& sent,
                                                       HeadInputs& inputs) {
  auto received = head_.receive_echoes(event, sent.sectors.front().settings, inputs.truth(), inputs.seabed());
  return {{std::move(received.ping), std::move(received.bottom)}, received.trace.rays_that_hit > 0};
}

}  // namespace ensonify
