#pragma once

#include <deque>
#include <set>
#include <string>
#include <vector>

#include "components/config/config_reader.h"
#include "components/config/parse_yaml.h"

/// Internal to this folder: what readers of one document share.
namespace ensonify {

/// One map that somebody reads.
struct ConfigReader::State {
  Documents* documents = nullptr;
  const ConfigNode* map = nullptr;  // nullptr: a missing section, reading from it does nothing
  std::string path = {};
  bool is_document = false;
  std::set<std::string> known = {};
  std::string short_key = {};  // of a map that stands for a single value: the key does not show

  std::string path_of(std::string_view key) const {
    if (!short_key.empty() && key == short_key) return path;
    return path + (path.empty() || key.empty() ? "" : ".") + std::string(key);
  }
};

/// State that all readers of one finish() share. Every reader's pointer keeps it alive as a whole.
struct ConfigReader::Documents {
  std::deque<ConfigNode> roots;
  std::deque<State> maps;
  std::vector<ConfigProblem> problems;

  State& open(ConfigDocument document, const std::string& path, bool is_document) {
    problems.insert(problems.end(), document.problems.begin(), document.problems.end());
    roots.push_back(std::move(document.root));
    maps.push_back({this, &roots.back(), path, is_document});
    return maps.back();
  }
};

/// Text of the node, for a message: `is "7 knots"`, "is a list".
std::string described(const ConfigNode& node);
/// With commas between.
std::string joined(const std::vector<std::string>& words);

}  // namespace ensonify
