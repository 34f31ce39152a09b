#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "components/runtime/ports.h"
#include "components/vehicle/model.h"
#include "components/vehicle/pilots.h"
#include "messages/actuators.h"
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
  void declare_command();
  void take(const std::string& pilot, const msg::Guidance& guidance);
  void take(const std::string& pilot, const msg::Actuators& order);
  void refuse(const std::string& pilot, const std::string& refusal);
  void report_helm(SimTime now);

  VehicleConfig config_;
  Ports& ports_;
  Periodic poses_due_, helm_due_;
  std::optional<VehicleModel> vehicle_;  // empty until it is known where to start
  Pilots pilots_;
  std::int64_t refused_ = 0;
  bool finished_ = false;  // at the end of a recorded track
  std::optional<msg::Chart> chart_;
  Ports::Out<msg::Pose> poses_;
  std::optional<Ports::Out<msg::Helm>> helms_;  // only with several pilots
};

}  // namespace ensonify
