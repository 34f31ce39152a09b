#include "components/echosounder/node.h"

namespace ensonify {

HeadPlan Echosounder::plan(const Config& config) {
  HeadSettings longest = config.start();
  longest.pulse_length_s = config.limits()["pulse_length_s"].most;
  return {.channels = {{"", config.start(), config.limits(), {{config.frequency_hz}}}},
          .longest_reception_s = config.reception_s(longest),
          .finest_beam_rad = config.beamwidth_rad};
}

HeadOutputs<msg::Ping, msg::BottomTrack> Echosounder::outputs() const {
  const double samples = plan(config_).longest_reception_s / config_.sample_period_s();
  return {{"ping", sizeof(float) * static_cast<std::size_t>(samples + 2.0) + 65536}, {"bottom"}};
}

SentPing Echosounder::transmit(SimTime, const HeadSettings& settings, const HeadInputs&) const {
  return {{{config_.frequency_hz, settings.pulse_length_s, from_seconds(config_.reception_s(settings)), settings}}};
}

HeadReport<msg::Ping, msg::BottomTrack> Echosounder::ping(const PingEvent& event, const SentPing& sent,
                                                          HeadInputs& inputs) {
  auto received = head_.receive_echoes(event, sent.sectors.front().settings, inputs.truth(), inputs.seabed());
  const std::string trouble = received.bottom.valid ? "" : "no echo stands out of the water column: no depth";
  return {{std::move(received.ping), std::move(received.bottom)}, received.trace.rays_that_hit > 0, trouble};
}

}  // namespace ensonify
