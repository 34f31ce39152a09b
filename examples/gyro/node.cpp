#include "examples/gyro/node.h"

namespace ensonify {

GyroNode::GyroNode(const Config& config, Ports& ports)
    : gyro_(config),
      due_(Rate{config.rate_hz, 1}),
      headings_(ports.out<msg::Attitude>("heading", {.rate = Rate{config.rate_hz, 1}})) {
  ports.in<msg::Pose>("pose", [this](const msg::Pose& pose) { truth_ = pose; });
}

SimTime GyroNode::step(SimTime now) {
  const std::int64_t sample = due_.count();
  if (due_.due(now) && truth_) headings_.send(gyro_.measure(*truth_, sample));
  return due_.next();
}

}  // namespace ensonify
