#include "components/config/overrides.h"

namespace ensonify {

std::vector<ConfigProblem> apply(const Overrides& overrides, ConfigNode& root) {
  std::vector<ConfigProblem> problems;
  for (const auto& [path, value] : overrides) {
    if (const std::string why = set_config_value(root, path, value); !why.empty()) {
      problems.push_back({value.place, path, why});
    }
  }
  return problems;
}

}  // namespace ensonify
