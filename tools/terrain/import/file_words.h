#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/terrain/import/options.h"

namespace ensonify::terrain_import {

/// The whole text as a number; nothing if it is none.
std::optional<double> number_in(const std::string& text);

/// Numbers with commas between; throws UserError, beginning with `option`, unless there are from `least` to `most`.
std::vector<double> numbers_in(const std::string& text, const std::string& option, std::size_t least, std::size_t most);

/// A file as it stands on the command line: "PATH" or "PATH?key=value&key=value", with what is said of all files for
/// the rest. Keys: crs, positive, units, nodata (with commas), datum-shift, vertical, band. Throws UserError.
FileOptions file_of(const std::string& words, FileOptions all);

}  // namespace ensonify::terrain_import
