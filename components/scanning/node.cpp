#include "components/scanning/node.h"

namespace ensonify {

HeadPlan Scanning::plan(const Config& config) {
  return {.channels = {{"", config.start(), config.limits(), {{config.frequency_hz}}}},
          .longest_reception_s = longest_reception_s(config.pulse, config.longest_range_m, config.sound_speed_mps),
          .finest_beam_rad = config.horizontal_beamwidth_rad,
          .beam_axis = BeamAxis::kForward,
          .probe = true};
}

SentPing Scanning::transmit(SimTime, const HeadSettings& settings, const HeadInputs& inputs) const {
  const RangedPulse pulse = head_.pulse_for(settings);
  return {{{frequency_hz_, pulse.length_s, from_seconds(pulse.reception_s()), settings}}, inputs.sound_speed_mps()};
}

HeadReport<msg::Ping> Scanning::ping(const PingEvent& event, const SentPing& sent, HeadInputs& inputs) {
  auto received =
      head_.receive_echoes(event, sent.sectors.front().settings, sent.sound_speed_mps, inputs.truth(), inputs.seabed());
  return {.messages = {std::move(received.ping)}, .trouble = no_echo_reason(received.trace)};
}

}  // namespace ensonify
