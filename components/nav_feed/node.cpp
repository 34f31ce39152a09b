#include "components/nav_feed/node.h"

#include <algorithm>
#include <utility>

#include "components/runtime/log.h"
#include "components/truth/pose_message.h"

namespace ensonify {

NavFeedNode::NavFeedNode(const Config& config, Ports& ports)
    : config_(config),
      ports_(ports),
      poses_due_(Rate{config.pose_rate_hz, 1}),
      poses_(ports.out<msg::Pose>("pose", {.rate = Rate{config.pose_rate_hz, 1}})),
      fixes_(ports.out<msg::Position>("fix", {.rate = Rate{config.pose_rate_hz, 1}})),
      input_(ports, {config.sources.begin(), config.sources.end()}, config.recorded, Rate{config.pose_rate_hz, 1}),
      fixes_allowed_(Rate{config.pose_rate_hz, 1}) {
  const auto count = [this](const std::string& what) { ports_.count(what); };
  for (const FeedSource& source : config_.sources) decoders_.emplace_back(source, count);
  const auto start = [this](const frames::Geodetic& origin) {
    track_.emplace(config_, frames::LocalProjection(origin), [this](const std::string& what) { ports_.count(what); });
  };
  if (config.origin) {
    start(*config.origin);
  } else {
    ports.in<msg::Chart>("chart", [start](const msg::Chart& chart) {
      start({chart.origin_latitude_deg, chart.origin_longitude_deg});
    });
  }
}

SimTime NavFeedNode::step(SimTime now) {
  if (!poses_due_.due(now)) return poses_due_.next();
  input_.open();
  if (!track_) return poses_due_.next();
  receive(now);
  if (const auto moving = track_->at(now)) poses_.send(pose_message(now, at_its_height(*moving, now)));
  if (track_->lacks_data(now)) ports_.count("poses_guessed");
  std::string trouble = input_.trouble();
  const std::string of_track = track_->trouble(now);
  if (!trouble.empty() && !of_track.empty()) trouble += "; ";
  trouble += of_track;
  ports_.health(trouble.empty() ? "ok" : "degraded", trouble);
  track_->forget(now);
  return poses_due_.next();
}

void NavFeedNode::receive(SimTime now) {
  for (const FedPiece& piece : input_.take(now)) take(piece, now);
  const auto fix = track_->take_fix();
  if (!fix) return;
  if (!fixes_allowed_.take(1, now)) return ports_.count("fixes_too_many");
  log::event(ports_, "fix", "stamp_s={:.3f} latitude_deg={:.7f} longitude_deg={:.7f} quality={}",
             seconds(SimTime{fix->stamp_ns}), fix->latitude_deg, fix->longitude_deg, fix->quality);
  fixes_.send(*fix);
}

void NavFeedNode::take(const FedPiece& piece, SimTime now) {
  const SimTime measured =
      std::clamp(piece.arrival, SimTime{0}, now) - from_seconds(config_.sources[piece.source].latency_s);
  decoders_[piece.source].take(piece.bytes, piece.begins, piece.whole, [&](const nmea::Navigation& said) {
    track_->take(said, {measured, piece.source});
  });
}

/// The vehicle of the feed on the water of the world: it heaves about the water level, less what it settles by. One
/// whose height the feed gives is where it is.
frames::MovingPose NavFeedNode::at_its_height(frames::MovingPose moving, SimTime now) {
  if (config_.height == NavFeedConfig::Height::kGga) return moving;
  const double t_s = seconds(now);
  const double speed_mps =
      (moving.velocity_enu_mps.head<2>() - config_.current.velocity_enu_mps(0.0, t_s)).norm();  // through the water
  if (!floating_) floating_.emplace(config_.tide, config_.floats, speed_mps, t_s);
  floating_->advance(speed_mps, t_s);
  const vertical::Level afloat = floating_->at_last();
  moving.pose.position_enu_m.z() += afloat.height_m;
  moving.velocity_enu_mps.z() += afloat.rate_mps;
  moving.acceleration_enu_mps2.z() += afloat.acceleration_mps2;
  return moving;
}

}  // namespace ensonify
