#pragma once

#include <array>
#include <string>

#include "kernels/vehicle/motion/towed_body.h"
#include "scenarios/world/world.h"

namespace ensonify {

class ConfigReader;

/// Positioning of the body aboard the vessel.
struct TowPositioning {
  enum class By {
    kLayback,  // from the cable out and the depth: so far back on the vessel's own track
    kUsbl,     // from fixes of an acoustic array under the vessel
  };
  static constexpr double kDegree_rad = 3.14159265358979323846 / 180.0;

  By by = By::kLayback;
  double cable_scale = 0.0;     // relative error of the cable counter, as it is
  double layback_factor = 1.0;  // layback over that of a straight cable, as it is assumed
  double usbl_gain = 0.2;       // how much of a fix's difference from the estimate is taken over
  double depth_white_m = 0.05;  // standard deviations of what the body's own sensors give, each sample
  double heading_white_rad = 0.5 * kDegree_rad;
  double level_white_rad = 0.05 * kDegree_rad;  // roll and pitch each

  bool operator==(const TowPositioning&) const = default;
};

struct TowedBodyConfig {
  int pose_rate_hz = 50;
  motion::TowCable cable;
  motion::TowedBody body;
  std::array<double, 3> sheave_m{-5.0, 0.0, -2.0};  // on the vessel: forward, starboard, down
  double depth_lag_s = 10.0;                        // time constant with which depth and layback follow speed
  TowPositioning positioning;

  // From the scenario.
  std::string process;
  std::string name;  // of the body
  std::uint64_t seed = 1;
  motion::DisturbanceParameters disturbance;
  motion::Current current;

  static TowedBodyConfig read(ConfigReader& from, const World& world, const std::string& process);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const TowedBodyConfig& other) const;
};

}  // namespace ensonify
