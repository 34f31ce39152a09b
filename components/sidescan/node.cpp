#include "components/sidescan/node.h"

#include <fmt/format.h>

#include <algorithm>

#include "components/runtime/head/head_motion.h"
#include "components/runtime/log.h"

namespace ensonify {
namespace {

double longest_listening_s(const SidescanConfig& config) {
  double longest_s = 0.0;
  for (const SidescanChannel& channel : config.channels) {
    const double pulse_s = config.limits_of(channel).pulse_length_s->most;
    longest_s = std::max(longest_s, config.listening_s(channel.range_m, pulse_s));
  }
  return longest_s;
}

/// Poses older than the longest ping and its processing are never asked for again.
std::int64_t keep_ns(const SidescanConfig& config) {
  return from_seconds(2.0 * (longest_listening_s(config) + config.processing_latency_s) + 1.0).count();
}

}  // namespace

SidescanNode::SidescanNode(const Config& config, Ports& ports)
    : ports_(ports),
      config_(config),
      clock_(config.ping_rate(), from_seconds(config.dead_time_s)),
      truth_(keep_ns(config)),
      estimate_(keep_ns(config)),
      transmit_out_(ports.out<msg::Transmit>("transmit", {.rate = config.ping_rate()})) {
  double finest_rad = 1.0;
  for (const SidescanChannel& channel : config.channels) {
    SidescanHead head(config, channel);
    const OutOptions ping_options{.max_bytes = head.max_ping_bytes(), .rate = config.ping_rate()};
    channels_.push_back({channel, CommandedSettings(config.start_of(channel), config.limits_of(channel)),
                         std::move(head), ports.out<msg::Ping>("ping_" + channel.name, ping_options),
                         ports.out<msg::BottomTrack>("bottom_" + channel.name, {.rate = config.ping_rate()})});
    finest_rad = std::min(finest_rad, channel.horizontal_beamwidth_rad);
  }
  ports.note("finest_beam_rad", finest_rad);
  ports.in<msg::Pose>("pose", [this](const msg::Pose& pose) { push(truth_, pose); });
  ports.in<msg::Estimate>("estimate", [this](const msg::Estimate& estimate) { push(estimate_, estimate); });
  ports.in<msg::Tile>("tile", [this](const msg::Tile& tile) { tiles_.insert(tile); });
  ports.in<msg::TileRelease>("release", [this](const msg::TileRelease& release) { tiles_.release(release); });
  ports.in<msg::SonarSettings>("settings", [this](const msg::SonarSettings& wanted) { command(wanted); },
                               {.optional = true});
}

void SidescanNode::command(const msg::SonarSettings& wanted) {
  for (Channel& channel : channels_) {
    for (const std::string& remark : channel.settings.command(wanted)) {
      log::event(ports_, "settings", "channel={} {}", channel.config.name, remark);
      ports_.count("settings_not_as_wanted");
    }
  }
}

SimTime SidescanNode::step(SimTime now) {
  while (!pending_.empty() && pending_.front().ready <= now) {
    receive(pending_.front());
    pending_.pop_front();
  }
  if (clock_.next() <= now) transmit(now);
  return pending_.empty() ? clock_.next() : std::min(clock_.next(), pending_.front().ready);
}

void SidescanNode::transmit(SimTime now) {
  const auto body = truth_.at(now.count(), frames::PoseHistory::Outside::kNearest);
  if (!body) return skip("no pose of the vehicle has arrived");
  const frames::Vec3 place = frames::head_pose(*body, config_.mounting.actual).position_enu_m;
  if (!tiles_.covers(place.head<2>())) {
    return skip(fmt::format("no seabed tile under the head at ({:.0f}, {:.0f}) m", place.x(), place.y()));
  }
  Pending pending{pings_++, now, now, {}};
  double listening_s = 0.0;
  for (Channel& channel : channels_) {
    const HeadSettings& settings = channel.settings.at_ping();
    pending.settings.push_back(settings);
    listening_s = std::max(listening_s, config_.listening_s(settings.range_m, settings.pulse_length_s));
    msg::Transmit transmit;
    transmit.stamp_ns = now.count();
    transmit.ping = pending.ping;
    transmit.frequency_hz = channel.config.frequency_hz;
    transmit.pulse_length_s = settings.pulse_length_s;
    transmit.source_level_db = settings.source_level_db;
    transmit_out_.send(transmit);
  }
  const SimTime listening = from_seconds(listening_s);
  pending.ready = now + listening + from_seconds(config_.processing_latency_s);
  clock_.set_rate(SidescanConfig::rate_of(pending.settings.front().ping_rate_hz));
  clock_.transmitted(listening);
  pending_.push_back(std::move(pending));
}

void SidescanNode::skip(const std::string& why) {
  clock_.skipped();
  ports_.count("pings_skipped");
  ports_.health("degraded", why);
}

void SidescanNode::receive(const Pending& pending) {
  ports_.count("pings");
  std::string silent;  // channels that could only hear noise
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    Channel& channel = channels_[i];
    const HeadSettings& settings = pending.settings[i];
    auto heard =
        channel.head.listen({pending.ping, pending.transmit, settings.range_m}, settings, truth_, tiles_.scene());
    const SimTime listening = from_seconds(config_.listening_s(settings.range_m, settings.pulse_length_s));
    fill(heard.ping.track, estimate_, config_.mounting.measured, pending.transmit, listening);
    channel.ping_out.send(heard.ping);
    channel.bottom_out.send(heard.bottom);
    if (channel.head.rays_that_hit() == 0) {
      silent += fmt::format("{}{} ({:.0f} m)", silent.empty() ? "" : ", ", channel.config.name, settings.range_m);
    }
  }
  if (!silent.empty()) {
    return ports_.health("degraded",
                         fmt::format("no seabed within the range of {}: the range is below the altitude, or "
                                     "the terrain has a hole here",
                                     silent));
  }
  if (estimate_.empty()) return ports_.health("degraded", "no navigation estimate has arrived: pings have no track");
  ports_.health("ok", "");
}

}  // namespace ensonify
