#pragma once

#include <string>
#include <vector>

namespace ensonify::doctor {

enum class Level { kOk, kWarn, kFail };

/// Finding of one check. `advice` is empty when all is well.
struct Finding {
  std::string check;  // one or two words
  Level level = Level::kOk;
  std::string text;
  std::string advice;
};
using Findings = std::vector<Finding>;

inline const char* word_of(Level level) { return level == Level::kOk ? "ok" : level == Level::kWarn ? "warn" : "fail"; }

}  // namespace ensonify::doctor
