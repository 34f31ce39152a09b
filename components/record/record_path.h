#pragma once

#include <string>

namespace ensonify::record {

/// The record that a path means: the file itself, or the only .mcap of a run's folder. Throws UserError for a folder
/// that holds none or several.
std::string record_path(const std::string& path);

}  // namespace ensonify::record
