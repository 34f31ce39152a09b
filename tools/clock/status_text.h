#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ensonify::clock_tool {

/// The clock's answer to `status`, for people: one line for the run, one for each participant.
std::string status_text(const nlohmann::json& status);

}  // namespace ensonify::clock_tool
