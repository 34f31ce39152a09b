#include "components/runtime/config/config_error.h"

#include <algorithm>
#include <numeric>
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

/// Levenshtein's distance with swaps of neighbours counted as one (the commonest slip of the fingers).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    d[i][0] = i;
  }
  std::iota(d[0].begin(), d[0].end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, changed});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[a.size()][b.size()];
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
  return text + ": " + (key.empty() ? "" : key + ": ") + message;
}

ConfigError::ConfigError(std::vector<ConfigProblem> problems)
    : UserError(joined(sorted(problems))), problems_(sorted(std::move(problems))) {}

std::string nearest_name(const std::string& name, const std::vector<std::string>& known) {
  constexpr std::size_t kLongestComparedName = 200;
  if (name.size() > kLongestComparedName) {
    return "";
  }
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const auto& candidate : known) {
    if (candidate.size() > kLongestComparedName) {
      continue;
    }
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace ensonify
