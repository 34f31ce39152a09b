#include "components/forward_looking/node.h"

namespace ensonify {

HeadPlan ForwardLooking::plan(const Config& config) {
  return {.channels = {{"", config.start(), config.limits(), {{config.frequency_hz}}}},
          .longest_reception_s = longest_reception_s(config.pulse, config.longest_range_m, config.sound_speed_mps),
          .finest_beam_rad = config.beamwidth_rad,
          .beam_axis = BeamAxis::kForward,
          .near_field_m = near_field_m(config),
          .probe = true};
}

SentPing ForwardLooking::transmit(SimTime, const HeadSettings& settings, const HeadInputs& inputs) const {
  const RangedPulse pulse = head_.pulse_for(settings);
  const double bandwidth_hz = config_.pulse.chirp ? pulse.band_hz : 0.0;
  return {{{config_.frequency_hz, pulse.length_s, from_seconds(pulse.reception_s()), settings, bandwidth_hz}},
          inputs.sound_speed_mps()};
}

HeadReport<msg::Ping> ForwardLooking::ping(const PingEvent& event, const SentPing& sent, HeadInputs& inputs) {
  auto received =
      head_.receive_echoes(event, sent.sectors.front().settings, sent.sound_speed_mps, inputs.truth(), inputs.seabed());
  return {.messages = {std::move(received.ping)}, .trouble = no_echo_reason(received.trace)};
}

}  // namespace ensonify
