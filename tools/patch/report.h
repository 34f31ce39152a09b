#pragma once

#include <string>
#include <vector>

#include "kernels/survey/boresight/adjust.h"
#include "tools/patch/record_soundings.h"

namespace ensonify::patch_tool {

/// Result of a patch test, and its input.
struct Finding {
  RecordInput input;           // its soundings have gone into `lines`
  std::vector<RunLine> lines;  // all that were found
  std::vector<bool> used;      // of the lines
  boresight::Adjusted adjusted;
};

std::string as_text(const Finding& finding);
std::string as_json(const Finding& finding);

}  // namespace ensonify::patch_tool
