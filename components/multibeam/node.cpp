#include "components/multibeam/node.h"

#include <fmt/format.h>

#include <algorithm>

#include "components/runtime/head/environment.h"
#include "components/runtime/head/head_motion.h"

namespace ensonify {
namespace {

/// Poses older than the longest ping and its processing are never asked for again.
std::int64_t keep_ns(const MultibeamConfig& config) {
  const SimTime ping = config.listening_time(config.range_m) + from_seconds(config.processing_latency_s);
  return (2 * ping + 1_s).count();
}

std::size_t soundings_bytes(const MultibeamConfig& config) {
  const auto poses =
      static_cast<std::size_t>(config.listening_time(config.range_m) / kTrackPeriod) + 3;  // 8 numbers each
  return static_cast<std::size_t>(config.beams) * 64 + poses * 64 + 8192;
}

}  // namespace

MultibeamNode::MultibeamNode(const Config& config, Ports& ports)
    : ports_(ports),
      config_(config),
      head_(config),
      applied_(applied_profile(config.world)),
      soundings_(config),
      clock_(ports, {.rate = config.ping_rate(), .dead_time = from_seconds(config.dead_time_s)}),
      range_(config.range_m, 0.5 * config.swath_rad, config.beams),
      truth_(keep_ns(config)),
      estimate_(keep_ns(config)),
      ping_out_(ports.out<msg::Ping>("ping", {.max_bytes = head_.max_ping_bytes(), .rate = config.ping_rate()})),
      soundings_out_(
          ports.out<msg::Soundings>("soundings", {.max_bytes = soundings_bytes(config), .rate = config.ping_rate()})),
      transmit_out_(ports.out<msg::Transmit>("transmit", {.rate = config.ping_rate()})) {
  ports.note("finest_beam_rad", std::min(config.transmit_beamwidth_rad, config.receive_beamwidth_rad));
  ports.in<msg::Pose>("pose", [this](const msg::Pose& pose) { push(truth_, pose); });
  ports.in<msg::Estimate>("estimate", [this](const msg::Estimate& estimate) { push(estimate_, estimate); });
  ports.in<msg::SoundSpeed>("sound_speed", [this](const msg::SoundSpeed& probe) { probe_mps_ = probe.sound_speed_mps; },
                            {.optional = true});
  ports.in<msg::Attitude>("attitude",
                          [this](const msg::Attitude& sensor) {
                            attitude_ = {sensor.heading_grid_rad, sensor.pitch_rad, sensor.roll_rad};
                          },
                          {.delay = from_seconds(config.attitude_latency_s), .optional = true});
  ports.in<msg::Tile>("tile", [this](const msg::Tile& tile) { tiles_.insert(tile); });
  ports.in<msg::TileRelease>("release", [this](const msg::TileRelease& release) { tiles_.release(release); });
}

SimTime MultibeamNode::step(SimTime now) {
  while (!pending_.empty() && pending_.front().ready <= now) {
    receive(pending_.front().shot, pending_.front().belief);
    pending_.pop_front();
  }
  if (clock_.due(now)) transmit(now);
  return pending_.empty() ? clock_.next() : std::min(clock_.next(), pending_.front().ready);
}

void MultibeamNode::transmit(SimTime now) {
  if (truth_.empty()) return skip("no pose of the vehicle has arrived");
  const auto body = truth_.at(now.count(), frames::PoseHistory::Outside::kNearest);
  const frames::Vec3 place = frames::head_pose(*body, config_.mounting.actual).position_enu_m;
  if (!tiles_.covers(place.head<2>())) {
    return skip(fmt::format("no seabed tile under the head at ({:.0f}, {:.0f}) m", place.x(), place.y()));
  }
  const Shot shot{pings_++, now, config_.auto_range ? range_.range_m() : config_.range_m};
  msg::Transmit transmit;
  transmit.stamp_ns = now.count();
  transmit.ping = shot.ping;
  transmit.frequency_hz = config_.frequency_hz;
  transmit.pulse_length_s = config_.pulse_length_s;
  transmit.source_level_db = config_.source_level_db;
  transmit_out_.send(transmit);
  const SimTime listening = config_.listening_time(shot.range_m);
  pending_.push_back({shot, belief(now), now + listening + from_seconds(config_.processing_latency_s)});
  clock_.transmitted(now, listening);
}

/// Until the probe tells, the head takes the applied profile's speed at the depth where it believes to be.
Belief MultibeamNode::belief(SimTime now) const {
  if (probe_mps_) return {*probe_mps_, attitude_};
  const auto body = estimate_.at(now.count(), frames::PoseHistory::Outside::kNearest);
  return {applied_.speed_mps(body ? -frames::head_pose(*body, config_.mounting.measured).position_enu_m.z()
                                  : config_.world.mission.depth_m),
          attitude_};
}

void MultibeamNode::skip(const std::string& why) {
  clock_.skipped();
  ports_.count("pings_skipped");
  ports_.health("degraded", why);
}

void MultibeamNode::receive(const Shot& shot, const Belief& belief) {
  const Steering steering = steer(config_, belief);
  const MultibeamHead::Heard heard = head_.listen(shot, steering, truth_, tiles_.scene());
  ports_.count("pings");
  if (shot.ping % config_.amplitude_every == 0) ping_out_.send(head_.ping_message(shot, steering));
  msg::Soundings soundings = soundings_.make(shot, steering, heard, estimate_);
  soundings.applied = head_.applied(shot, steering);
  fill(soundings.track, estimate_, config_.mounting.measured, shot.transmit, config_.listening_time(shot.range_m));
  soundings_out_.send(soundings);
  range_.update(soundings_.heard(), shot.range_m);
  report(shot, soundings_.heard().size());
}

void MultibeamNode::report(const Shot& shot, std::size_t detections) {
  if (head_.rays_that_hit() == 0) {
    return ports_.health("degraded",
                         fmt::format("no seabed within the range of {:.0f} m: the range is below the altitude, "
                                     "or the terrain has a hole here",
                                     shot.range_m));
  }
  if (estimate_.empty()) return ports_.health("degraded", "no navigation estimate has arrived: no soundings");
  if (detections == 0) return ports_.health("degraded", "no beam detects the seabed");
  ports_.health("ok", "");
}

}  // namespace ensonify
