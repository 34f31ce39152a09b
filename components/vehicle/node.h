#pragma once

#include <optional>

#include "components/runtime/ports.h"
#include "components/vehicle/model.h"
#include "messages/motion.h"
#include "messages/terrain.h"

namespace ensonify {

class VehicleNode {
 public:
  using Config = VehicleConfig;
  static constexpr const char* kComponent = "vehicle";

  VehicleNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);

 private:
  VehicleConfig config_;
  Ports& ports_;
  Periodic poses_due_;
  std::optional<VehicleModel> vehicle_;  // empty until it is known where to start
  std::optional<msg::Guidance> command_;
  std::optional<msg::Chart> chart_;
  Ports::Out<msg::Pose> poses_;
};

}  // namespace ensonify
