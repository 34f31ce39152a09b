#pragma once

#include <optional>

#include "components/runtime/ports.h"
#include "examples/gyro/model.h"

namespace ensonify {

class GyroNode {
 public:
  using Config = GyroConfig;
  static constexpr const char* kComponent = "gyro";

  GyroNode(const Config& config, Ports& ports);

  /// Runs at its own event times, when every input due by `now` has arrived. Returns the next event time.
  SimTime step(SimTime now);

 private:
  GyroModel gyro_;
  Periodic due_;
  std::optional<msg::Pose> truth_;
  Ports::Out<msg::Attitude> headings_;
};

}  // namespace ensonify
