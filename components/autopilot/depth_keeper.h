#pragma once

#include <optional>

#include "components/runtime/sim_time.h"
#include "kernels/vehicle/guidance/laws.h"
#include "scenarios/world/mission.h"

namespace ensonify {

/// Whether a mission is nowhere run as it says without an altimeter: it follows the bottom, or has an obstacle floor.
bool needs_altimeter(const Mission& mission);

/// Depth to hold: a depth, or above the bottom that the altimeter measures, and never nearer to it than the mission's
/// obstacle floor. An altimeter that measures nothing for 10 s is no longer valid: an altitude is given up for the
/// mission's depth, or for the present depth where that is shallower.
class DepthKeeper {
 public:
  DepthKeeper(const Mission& mission, double climb_mps);

  /// Whether depth is steered at all. A mission that says nothing of depths leaves a vehicle where it is.
  bool steers() const { return steers_; }
  void go_at(const GoAt& order);
  /// An altitude or an obstacle floor is to be kept, and no bottom is detected to keep it from.
  bool bottom_lost(SimTime now) const;

  /// A reading of the altimeter, turned to the vertical, at an own depth.
  void take_altitude(SimTime at, double altitude_m, double depth_m);
  /// Order to hold at an own depth. Only when steers().
  guidance::HeightOrder order(SimTime now, double depth_m) const;

 private:
  bool has_recent_bottom(SimTime now) const;

  bool steers_;
  double mission_depth_m_, depth_m_;
  std::optional<double> above_m_;
  guidance::HeightRules rules_;
  guidance::BottomTrack bottom_;
  double altitude_m_ = 0.0;
  SimTime bottom_at_{};
};

}  // namespace ensonify
