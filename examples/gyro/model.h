#pragma once

#include <cstdint>

#include "examples/gyro/config.h"
#include "kernels/base/random/stream.h"
#include "messages/motion.h"
#include "messages/navigation.h"

namespace ensonify {

/// Heading plus bias and noise; sample n is a pure function of the configuration, n and the truth.
class GyroModel {
 public:
  explicit GyroModel(const GyroConfig& config) : config_(config), noise_(config.seed, config.process + "/heading") {}

  msg::Attitude measure(const msg::Pose& truth, std::int64_t n) const;

 private:
  GyroConfig config_;
  random::Stream noise_;
};

}  // namespace ensonify
