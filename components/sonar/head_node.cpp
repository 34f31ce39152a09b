#include "components/sonar/head_node.h"

#include <fmt/format.h>

#include <algorithm>

namespace ensonify {

HeadInputs::Start inputs_of(const HeadConfig& config, const HeadPlan& plan) {
  std::size_t transmissions = 0;
  for (const HeadInputs::Channel& channel : plan.channels) transmissions += channel.sectors.size();
  HeadInputs::Start start;
  start.mounting = config.mounting;
  start.tide = config.world->vertical.tide;
  start.lod = config.lod;
  start.lod.adaptations_per_ping = static_cast<std::int32_t>(transmissions);
  start.longest_ping = from_seconds(plan.longest_reception_s + config.processing_latency_s);
  start.sound_speed_mps = config.sound_speed_mps;
  start.probe = plan.probe;
  start.channels = plan.channels;
  return start;
}

std::string axis_name(BeamAxis axis) { return axis == BeamAxis::kForward ? "forward" : "down"; }

msg::HeadDeclaration declaration_of(const std::string& kind, const HeadConfig& config, const HeadPlan& plan) {
  msg::HeadDeclaration head;
  head.kind = kind;
  head.instrument = plan.instrument;
  head.beam_axis = axis_name(plan.beam_axis);
  head.finest_beam_rad = plan.finest_beam_rad;
  head.near_field_m = plan.near_field_m;
  double range_m = 0.0;
  for (const HeadInputs::Channel& channel : plan.channels) {
    head.channels.push_back({channel.name, channel.sectors, channel.limits.declared()});
    const SettingLimit* range = channel.limits.find("range_m");
    if (range == nullptr) continue;
    head.auto_range = channel.settings.auto_range && (head.auto_range || range_m == 0.0);
    range_m = std::max(range_m, range->most);
  }
  if (range_m > 0.0) head.reach_m = range_m + config.mounting.actual.position_body_m.norm();
  const frames::Mounting& measured = config.mounting.measured;
  head.position_body_m = {measured.position_body_m.x(), measured.position_body_m.y(), measured.position_body_m.z()};
  head.body_from_head = frames::wxyz_of(measured.body_from_head);
  return head;
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
