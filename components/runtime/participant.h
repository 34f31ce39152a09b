#pragma once

#include <string>

#include "components/runtime/bus/link.h"
#include "components/runtime/stepper.h"
#include "components/runtime/wiring.h"

namespace ensonify {

/// Addresses of the others for a participant.
struct Meeting {
  std::string clock_endpoint;
  bus::Address address;
};

/// Takes part in a run: HELLO, the proof of every edge, grants until the end. Returns the process's exit code; throws
/// what the node or the bus throws, after reporting to the clock.
int participate(const std::string& component, Ports& ports, AnyNode& node, const Meeting& meeting);

}  // namespace ensonify
