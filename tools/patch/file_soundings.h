#pragma once

#include <string>
#include <vector>

#include "tools/patch/record_soundings.h"

namespace ensonify::patch_tool {

/// Input of a patch test from .kmall or .all files, in any order: their soundings, placed anew. Times count from the
/// first of them. They state no errors of positions and attitudes. Throws UserError for a file that is another, or
/// lacks something.
RecordInput read_files(const std::vector<std::string>& files, std::size_t most);

}  // namespace ensonify::patch_tool
