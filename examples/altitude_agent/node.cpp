#include "examples/altitude_agent/node.h"

namespace ensonify {

AltitudeAgentNode::AltitudeAgentNode(const Config& config, Ports& ports)
    : config_(config),
      due_(Rate{config.rate_hz, 1}),
      commands_(ports.out<msg::Guidance>("command", {.rate = Rate{config.rate_hz, 1}})) {
  ports.in<msg::Altitude>("altitude", [this](const msg::Altitude& altitude) {
    if (altitude.valid) view_.altitude = altitude;
  });
  ports.in<msg::Depth>("depth", [this](const msg::Depth& depth) { view_.depth = depth; });
}

SimTime AltitudeAgentNode::step(SimTime now) {
  if (!due_.due(now)) return due_.next();
  if (auto order = act(config_, view_)) {
    order->stamp_ns = now.count();
    commands_.send(*order);
  }
  return due_.next();
}

}  // namespace ensonify
