#include "components/config/config_error.h"

#include <algorithm>
#include <tuple>

namespace ensonify {
namespace {

std::vector<ConfigProblem> sorted(std::vector<ConfigProblem> problems) {
  const auto order = [](const ConfigProblem& p) {
    return std::tie(p.place.file, p.place.line, p.place.column, p.key, p.message);
  };
  std::sort(problems.begin(), problems.end(), [&](const auto& a, const auto& b) { return order(a) < order(b); });
  const auto same = [&](const auto& a, const auto& b) { return order(a) == order(b); };
  problems.erase(std::unique(problems.begin(), problems.end(), same), problems.end());
  return problems;
}

std::string joined(const std::vector<ConfigProblem>& problems) {
  std::string text;
  for (const auto& problem : problems) {
    text += (text.empty() ? "" : "\n") + problem.text();
  }
  return text;
}

}  // namespace

std::string ConfigProblem::text() const {
  // A place on the command line already names the key.
  if (place.line == 0 && place.file.starts_with("--")) {
    return place.file + ": " + message;
  }
  std::string text = place.file;
  if (place.line > 0) {
    text += ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
  }
  return (text.empty() ? "" : text + ": ") + (key.empty() ? "" : key + ": ") + message;
}

ConfigError::ConfigError(std::vector<ConfigProblem> problems)
    : UserError(joined(sorted(problems))), problems_(sorted(std::move(problems))) {}

}  // namespace ensonify
