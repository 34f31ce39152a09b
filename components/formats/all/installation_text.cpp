#include "components/formats/all/installation_text.h"

namespace ensonify::formats::all {

std::vector<std::pair<std::string, std::string>> installation_values(std::string_view text) {
  std::vector<std::pair<std::string, std::string>> values;
  while (!text.empty()) {
    const std::string_view pair = text.substr(0, text.find(','));
    text.remove_prefix(std::min(pair.size() + 1, text.size()));
    const std::size_t equals = pair.find('=');
    if (equals == std::string_view::npos) continue;
    values.emplace_back(pair.substr(0, equals), pair.substr(equals + 1));
  }
  return values;
}

}  // namespace ensonify::formats::all
