#pragma once

#include "tools/doctor/judgement.h"

namespace ensonify::doctor {

/// Folders of runs: their sockets, which runs are live, and remains of dead ones.
Findings check_runs();

}  // namespace ensonify::doctor
