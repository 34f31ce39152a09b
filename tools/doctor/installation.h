#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tools/doctor/judgement.h"

namespace ensonify::doctor {

/// Libraries of one program by the dynamic linker: library name to path, "" when it is not found.
using Libraries = std::map<std::string, std::string>;
/// Reads the linker's trace, lines such as "libzmq.so.5 => /lib/libzmq.so.5 (0x7f...)".
Libraries read_trace(const std::string& trace);

/// `missing`: library to the programs that need it.
Finding judge_libraries(std::size_t programs, const std::map<std::string, std::vector<std::string>>& missing);

/// Programs and the libraries they load with their versions, the project's data folders, and the Python client.
Findings check_installation();

}  // namespace ensonify::doctor
