#pragma once

#include "components/runtime/member.h"

namespace ensonify {

/// Takes part in a run: HELLO, the proof of every edge, grants until the end, and after a reset the same without proofs
/// with a session of its own. Returns the process's exit code, that of the first epoch whose node has one; throws what
/// the node or the bus throws, after reporting to the clock.
int participate(const OpenSession& open, const Meeting& meeting);

}  // namespace ensonify
