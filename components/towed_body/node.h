#pragma once

#include <optional>

#include "components/runtime/ports.h"
#include "components/towed_body/config.h"
#include "components/towed_body/positioning.h"
#include "messages/motion.h"
#include "messages/navigation.h"

namespace ensonify {

/// A body on a cable behind a vessel: where it truly is, and where it is estimated to be.
class TowedBodyNode {
 public:
  using Config = TowedBodyConfig;
  static constexpr const char* kComponent = "towed_body";

  TowedBodyNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);

 private:
  /// Moves on by one period behind the vessel.
  void tow();
  frames::MovingPose moving(SimTime now) const;

  Config config_;
  Ports& ports_;
  Periodic poses_due_;
  double period_s_;
  motion::Disturbance disturbance_;
  TowEstimator estimator_;
  std::optional<msg::Pose> vessel_;
  std::optional<motion::TowState> body_;
  frames::Vec3 velocity_enu_mps_ = frames::Vec3::Zero(), acceleration_enu_mps2_ = frames::Vec3::Zero();
  double turn_rate_radps_ = 0.0;
  Ports::Out<msg::Pose> poses_;
  Ports::Out<msg::Estimate> estimates_;
};

}  // namespace ensonify
