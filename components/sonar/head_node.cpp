#include "components/sonar/head_node.h"

#include <fmt/format.h>

namespace ensonify {

HeadInputs::Start inputs_of(const HeadConfig& config, const HeadPlan& plan) {
  HeadInputs::Start start;
  start.mounting = config.mounting;
  start.tide = config.world->vertical.tide;
  start.lod = config.lod;
  start.lod.adaptations_per_ping = plan.sectors * static_cast<std::int32_t>(plan.channels.size());
  start.longest_ping = from_seconds(plan.longest_reception_s + config.processing_latency_s);
  start.sound_speed_mps = config.sound_speed_mps;
  start.probe = plan.probe;
  start.channels = plan.channels;
  return start;
}

void note_head(Ports& ports, const HeadPlan& plan) {
  ports.note("finest_beam_rad", plan.finest_beam_rad);
  ports.note("beams_from_forward", plan.beam_axis == BeamAxis::kForward ? 1.0 : 0.0);
}

std::string no_seabed_reason(const std::vector<SilentChannel>& silent) {
  std::string channels;
  for (const SilentChannel& channel : silent) {
    channels += channels.empty() ? "" : ", ";
    channels += channel.name.empty() ? fmt::format("{:.0f} m", channel.range_m)
                                     : fmt::format("{} ({:.0f} m)", channel.name, channel.range_m);
  }
  return fmt::format(
      "no seabed within the range of {}: the range is below the altitude, or the terrain has a hole here", channels);
}

}  // namespace ensonify
