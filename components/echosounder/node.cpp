#include "components/echosounder/node.h"

#include <fmt/format.h>

#include <algorithm>

#include "components/runtime/head/head_motion.h"
#include "components/runtime/log.h"

namespace ensonify {
namespace {

/// With the longest range and pulse that can be set.
double longest_listening_s(const EchosounderConfig& config) {
  HeadSettings longest = config.start();
  longest.pulse_length_s = config.limits().pulse_length_s->most;
  return config.listening_s(longest);
}

std::size_t ping_bytes(const EchosounderConfig& config) {
  return sizeof(float) * static_cast<std::size_t>(longest_listening_s(config) / config.sample_period_s() + 2.0) + 65536;
}

/// Poses older than the longest ping and its processing are never asked for again.
std::int64_t keep_ns(const EchosounderConfig& config) {
  return from_seconds(2.0 * (longest_listening_s(config) + config.processing_latency_s) + 1.0).count();
}

}  // namespace

EchosounderNode::EchosounderNode(const Config& config, Ports& ports)
    : ports_(ports),
      config_(config),
      settings_(config.start(), config.limits()),
      head_(config),
      clock_(Config::rate_of(config.ping_rate_hz), from_seconds(config.dead_time_s)),
      truth_(keep_ns(config)),
      estimate_(keep_ns(config)),
      ping_out_(ports.out<msg::Ping>("ping",
                                     {.max_bytes = ping_bytes(config), .rate = Config::rate_of(config.ping_rate_hz)})),
      bottom_out_(ports.out<msg::BottomTrack>("bottom", {.rate = Config::rate_of(config.ping_rate_hz)})),
      transmit_out_(ports.out<msg::Transmit>("transmit", {.rate = Config::rate_of(config.ping_rate_hz)})) {
  ports.note("finest_beam_rad", config.beamwidth_rad);
  ports.in<msg::Pose>("pose", [this](const msg::Pose& pose) { push(truth_, pose); });
  ports.in<msg::Estimate>("estimate", [this](const msg::Estimate& estimate) { push(estimate_, estimate); });
  ports.in<msg::Tile>("tile", [this](const msg::Tile& tile) { tiles_.insert(tile); });
  ports.in<msg::TileRelease>("release", [this](const msg::TileRelease& release) { tiles_.release(release); });
  ports.in<msg::SonarSettings>("settings",
                               [this](const msg::SonarSettings& wanted) {
                                 for (const std::string& remark : settings_.command(wanted)) {
                                   log::event(ports_, "settings", "{}", remark);
                                   ports_.count("settings_not_as_wanted");
                                 }
                               },
                               {.optional = true});
}

SimTime EchosounderNode::step(SimTime now) {
  while (!pending_.empty() && pending_.front().ready <= now) {
    receive(pending_.front());
    pending_.pop_front();
  }
  if (clock_.next() <= now) transmit(now);
  return pending_.empty() ? clock_.next() : std::min(clock_.next(), pending_.front().ready);
}

void EchosounderNode::transmit(SimTime now) {
  const auto body = truth_.at(now.count(), frames::PoseHistory::Outside::kNearest);
  if (!body) return skip("no pose of the vehicle has arrived");
  const frames::Vec3 place = frames::head_pose(*body, config_.mounting.actual).position_enu_m;
  if (!tiles_.covers(place.head<2>())) {
    return skip(fmt::format("no seabed tile under the head at ({:.0f}, {:.0f}) m", place.x(), place.y()));
  }
  const HeadSettings& settings = settings_.at_ping();
  const Shot shot{pings_++, now, settings.range_m};
  msg::Transmit transmit;
  transmit.stamp_ns = now.count();
  transmit.ping = shot.ping;
  transmit.frequency_hz = config_.frequency_hz;
  transmit.pulse_length_s = settings.pulse_length_s;
  transmit.source_level_db = settings.source_level_db;
  transmit_out_.send(transmit);
  const SimTime listening = from_seconds(config_.listening_s(settings));
  pending_.push_back({shot, now + listening + from_seconds(config_.processing_latency_s), settings});
  clock_.set_rate(Config::rate_of(settings.ping_rate_hz));
  clock_.transmitted(listening);
}

void EchosounderNode::skip(const std::string& why) {
  clock_.skipped();
  ports_.count("pings_skipped");
  ports_.health("degraded", why);
}

void EchosounderNode::receive(const Pending& pending) {
  auto heard = head_.listen(pending.shot, pending.settings, truth_, tiles_.scene());
  const SimTime listening = from_seconds(config_.listening_s(pending.settings));
  fill(heard.ping.track, estimate_, config_.mounting.measured, pending.shot.transmit, listening);
  ping_out_.send(heard.ping);
  bottom_out_.send(heard.bottom);
  ports_.count("pings");
  if (head_.rays_that_hit() == 0) {
    return ports_.health("degraded", fmt::format("no seabed within the range of {:.0f} m: the range is below the "
                                                 "altitude, or the terrain has a hole here",
                                                 pending.settings.range_m));
  }
  if (!heard.bottom.valid) return ports_.health("degraded", "no echo stands out of the water column: no depth");
  ports_.health("ok", "");
}

}  // namespace ensonify
