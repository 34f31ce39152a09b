#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/info/summary.h"

namespace ensonify::info {

std::string text_of(const std::string& file, const Summary& summary);
nlohmann::ordered_json json_of(const std::string& file, const Summary& summary);

/// "2026-03-10T12:00:00.000Z"
std::string iso_time(std::int64_t unix_ns);

}  // namespace ensonify::info
