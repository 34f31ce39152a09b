#include "components/sidescan/node.h"

#include <fmt/format.h>

#include <algorithm>

namespace ensonify {
namespace {

HeadInputs::Start start_of(const SidescanConfig& config) {
  HeadInputs::Start start;
  start.mounting = config.mounting;
  start.tide = config.world.vertical.tide;
  start.lod = config.lod;
  start.lod.adaptations_per_ping = static_cast<std::int32_t>(config.channels.size());
  start.sound_speed_mps = config.sound_speed_mps;
  double longest_s = 0.0;
  for (const SidescanChannel& channel : config.channels) {
    const SettingLimits limits = config.limits_of(channel);
    longest_s = std::max(longest_s, config.reception_s(channel.range_m, limits.pulse_length_s->most));
    start.channels.push_back({channel.name, config.start_of(channel), limits});
  }
  start.longest_ping = from_seconds(longest_s + config.processing_latency_s);
  return start;
}

}  // namespace

SidescanNode::SidescanNode(const Config& config, Ports& ports)
    : config_(config), inputs_(ports, start_of(config)), cycle_(ports, inputs_, config.timing()) {
  const Rate rate = config.timing().rate;
  double finest_rad = 1.0;
  for (const SidescanChannel& channel : config.channels) {
    SidescanHead head(config, channel);
    const OutOptions ping_options{.max_bytes = head.max_ping_bytes(), .rate = rate};
    channels_.push_back({channel, std::move(head), ports.out<msg::Ping>("ping_" + channel.name, ping_options),
                         ports.out<msg::BottomTrack>("bottom_" + channel.name, {.rate = rate})});
    finest_rad = std::min(finest_rad, channel.horizontal_beamwidth_rad);
  }
  ports.note("finest_beam_rad", finest_rad);
}

SimTime SidescanNode::step(SimTime now) {
  return cycle_.step(
      now, [&] { transmit(now); }, [this](const PingUnderWay& ping) { publish(ping); });
}

void SidescanNode::transmit(SimTime now) {
  std::vector<Transmission> sent;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const HeadSettings& settings = inputs_.settings_at_ping(i);
    const double reception_s = config_.reception_s(settings.range_m, settings.pulse_length_s);
    sent.push_back({channels_[i].config.frequency_hz, settings.pulse_length_s, from_seconds(reception_s), settings,
                    channels_[i].config.bandwidth_hz});
  }
  cycle_.transmit(now, std::move(sent));
}

void SidescanNode::publish(const PingUnderWay& ping) {
  std::string silent;  // channels that could only receive noise
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    Channel& channel = channels_[i];
    const Transmission& sent = ping.channels[i];
    auto received = channel.head.receive_echoes(ping.event(i), sent.settings, inputs_.truth(), inputs_.seabed());
    inputs_.fill_track(received.ping.track, ping.transmit, sent.reception);
    channel.ping_out.send(received.ping);
    channel.bottom_out.send(received.bottom);
    if (channel.head.rays_that_hit() == 0) {
      silent += fmt::format("{}{} ({:.0f} m)", silent.empty() ? "" : ", ", channel.config.name, sent.settings.range_m);
    }
  }
  cycle_.published(silent.empty() ? ""
                                  : fmt::format("no seabed within the range of {}: the range is below the altitude, "
                                                "or the terrain has a hole here",
                                                silent));
}

}  // namespace ensonify
