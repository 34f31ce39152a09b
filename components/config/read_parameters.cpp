#include "components/config/read_parameters.h"

namespace ensonify {

void refuse_empty(const ConfigReader& from, const char* key, const std::string& text) {
  if (text.empty() && from.has(key)) from.problem(key, "is empty; allowed: a text");
}

}  // namespace ensonify
