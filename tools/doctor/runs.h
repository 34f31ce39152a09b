#pragma once

#include "tools/doctor/finding.h"

namespace ensonify::doctor {

/// Where runs keep their sockets, which runs are live, and what dead ones have left behind.
Findings check_runs();

}  // namespace ensonify::doctor
