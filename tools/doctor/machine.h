#pragma once

#include <string>

#include "tools/doctor/judgement.h"

namespace ensonify::doctor {

/// CPU, cores, memory, disks, open files and clock of this machine, and what tiles are kept from run to run. `out`:
/// where results will go.
Findings check_machine(const std::string& out);

}  // namespace ensonify::doctor
