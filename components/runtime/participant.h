#pragma once

#include <string>

#include "components/runtime/bus/link.h"
#include "components/runtime/session.h"

namespace ensonify {

/// Addresses of the others for a participant.
struct Meeting {
  std::string clock_endpoint;
  bus::Address address;
};

/// Takes part in a run: HELLO, the proof of every edge, grants until the end, and after a reset the same without proofs
/// with a session of its own. Returns the process's exit code, that of the first epoch whose node has one; throws what
/// the node or the bus throws, after reporting to the clock.
int participate(const OpenSession& open, const Meeting& meeting);

}  // namespace ensonify
