#pragma once

#include <cmath>
#include <numeric>
#include <vector>

#include "components/multibeam/node.h"
#include "components/multibeam/testing/head.h"
#include "components/runtime/testing/node_under_test.h"
#include "messages/motion.h"

/// For tests: surveys of a flat seabed, 20 m below the head, by the whole node.
namespace ensonify {

/// A square of seabed at one height about the origin, 256 m wide.
inline msg::Tile flat_tile(double height_m) {
  msg::Tile tile;
  tile.origin_east_m = tile.origin_north_m = -128.0;
  tile.spacing_m = 0.25;
  tile.height_m = msg::Array<float>({1025, 1025});
  for (float& h : tile.height_m.flat()) h = static_cast<float>(height_m);
  tile.sediment = msg::Array<std::uint8_t>({1025, 1025});
  return tile;
}

struct Track {
  double speed_mps = 0.0;
  double roll_rad = 0.0;  // amplitude
  double heave_m = 0.0;
  double depth_m = 0.0;  // of the head, at rest
  double heading_rad = 0.0;
  frames::Vec3 offset_enu_m = frames::Vec3::Zero();  // of the estimate from the truth
  bool motion_sensor = false;                        // whether there is an attitude, without error
};

inline frames::Pose pose_on(const Track& track, SimTime t) {
  const double s = seconds(t);
  frames::Pose pose;
  pose.position_enu_m = {0.0, track.speed_mps * s, track.heave_m * std::sin(1.1 * s) - track.depth_m};
  pose.enu_from_body = frames::enu_from_body({track.heading_rad, 0.0, track.roll_rad * std::sin(1.3 * s)});
  return pose;
}

using Head = NodeUnderTest<MultibeamNode>;

template <class Message>
void put_place(Message& message, const frames::Pose& pose) {
  for (std::size_t i = 0; i < 3; ++i) message.position_enu_m[i] = pose.position_enu_m[static_cast<Eigen::Index>(i)];
  message.enu_from_body = frames::wxyz_of(pose.enu_from_body);
}

inline void give_motion(Head& head, const Track& track, SimTime until) {
  head.give_each("pose", until, 10_ms, [&](SimTime t) {
    msg::Pose pose;
    pose.stamp_ns = t.count();
    put_place(pose, pose_on(track, t));
    return pose;
  });
  head.give_each("estimate", until, 10_ms, [&](SimTime t) {
    frames::Pose estimated = pose_on(track, t);
    estimated.position_enu_m += track.offset_enu_m;
    msg::Estimate estimate;
    estimate.stamp_ns = t.count();
    put_place(estimate, estimated);
    return estimate;
  });
  if (!track.motion_sensor) return;
  head.give_each("attitude", until, 10_ms, [&](SimTime t) {
    const auto truth = frames::attitude_of(pose_on(track, t).enu_from_body);
    msg::Attitude attitude;
    attitude.stamp_ns = t.count();
    attitude.heading_grid_rad = truth.heading_rad;
    attitude.roll_rad = truth.roll_rad;
    return attitude;
  });
}

/// 20 m of water, 60 m of range.
inline MultibeamConfig shallow() {
  MultibeamConfig config = head_in_plain_water();
  config.auto_range = false;
  config.range_m = 60.0;
  return config;
}

inline std::vector<msg::Soundings> survey(const MultibeamConfig& config, const Track& track, SimTime until) {
  Head head(config);
  give_motion(head, track, until);
  head.give("tile", flat_tile(-20.0));
  return head.step_until<msg::Soundings>("soundings", until);
}

inline int valid_count(const msg::Soundings& s) {
  return std::accumulate(s.valid.flat().begin(), s.valid.flat().end(), 0);
}

struct Spread {
  double mean = 0.0, sd = 0.0;
  int count = 0;
};

/// Depth minus 20 m of the soundings whose beam lies between two angles (to either side).
inline Spread depth_error(const std::vector<msg::Soundings>& pings, double from_deg, double to_deg) {
  double sum = 0.0, squares = 0.0;
  int n = 0;
  for (const auto& s : pings) {
    for (std::size_t beam = 0; beam < s.valid.size(); ++beam) {
      const double angle_deg = std::abs(s.beam_angle_rad[beam]) / MultibeamConfig::kDegree;
      if (s.valid[beam] == 0 || angle_deg < from_deg || angle_deg > to_deg) continue;
      const double error = -s.position_enu_m(beam, 2) - 20.0;
      sum += error, squares += error * error, ++n;
    }
  }
  if (n == 0) return {};
  return {sum / n, std::sqrt(std::max(0.0, squares / n - sum / n * sum / n)), n};
}

}  // namespace ensonify
