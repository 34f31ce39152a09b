#include "components/runtime/config/config_reader.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <filesystem>
#include <set>

#include "components/runtime/config/data_paths.h"
#include "components/runtime/config/scalars.h"

namespace ensonify {
namespace {

constexpr std::size_t kLongestQuotedText = 60;

std::string quoted(const std::string& text) {
  return "\"" + (text.size() > kLongestQuotedText ? text.substr(0, kLongestQuotedText) + "..." : text) + "\"";
}

std::string described(const ConfigNode& node) {
  switch (node.kind) {
    case ConfigNode::Kind::kNull: return "has no value";
    case ConfigNode::Kind::kList: return "is a list";
    case ConfigNode::Kind::kMap: return "is a map of keys";
    case ConfigNode::Kind::kScalar: break;
  }
  return "is " + quoted(node.scalar);
}

std::string range_text(double lo, double hi) {
  const bool below = lo > -std::numeric_limits<double>::max();
  const bool above = hi < std::numeric_limits<double>::max();
  if (!below && !above) {
    return "";
  }
  return (below ? "[" + shortest_number(lo) : "(-inf") + ", " + (above ? shortest_number(hi) + "]" : "inf)");
}

std::string number_text(double lo, double hi) {
  const std::string range = range_text(lo, hi);
  return range.empty() ? "a number" : "a number in " + range;
}

std::string integer_text(std::int64_t lo, std::int64_t hi) {
  std::string text = "a whole number";
  if (lo > std::numeric_limits<std::int64_t>::min() || hi < std::numeric_limits<std::int64_t>::max()) {
    text += " in [" + std::to_string(lo) + ", " + std::to_string(hi) + "]";
  }
  return text;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

}  // namespace

/// One map that somebody reads.
struct ConfigReader::State {
  Documents* documents = nullptr;
  const ConfigNode* map = nullptr;  // nullptr: a missing section, reading from it does nothing
  std::string path = {};
  bool is_document = false;
  std::set<std::string> known = {};

  std::string path_of(std::string_view key) const {
    return path + (path.empty() || key.empty() ? "" : ".") + std::string(key);
  }
};

/// What all readers of one finish() share. Every reader's pointer keeps it alive as a whole.
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

ConfigReader::ConfigReader(ConfigDocument document, const std::string& path) {
  auto documents = std::make_shared<Documents>();
  State& root = documents->open(std::move(document), path, true);
  state_ = std::shared_ptr<State>(std::move(documents), &root);
}

ConfigReader ConfigReader::from_file(const std::string& path) { return ConfigReader(parse_config_file(path)); }

ConfigReader ConfigReader::from_text(const std::string& text, const std::string& file) {
  return ConfigReader(parse_config(text, file));
}

ConfigReader ConfigReader::also(ConfigDocument document, const std::string& path) const {
  return ConfigReader(std::shared_ptr<State>(state_, &state_->documents->open(std::move(document), path, false)));
}

ConfigReader ConfigReader::child(const ConfigNode& node, const std::string& path) const {
  if (!node.is_map() && !node.is_null()) {
    state_->documents->problems.push_back({node.place, path, described(node) + ", not a map of keys"});
  }
  auto& maps = state_->documents->maps;
  maps.push_back({state_->documents, node.is_map() ? &node : nullptr, path});
  return ConfigReader(std::shared_ptr<State>(state_, &maps.back()));
}

const ConfigNode* ConfigReader::take(std::string_view key, bool must, const std::string& allowed) const {
  if (state_->map == nullptr) {
    return nullptr;
  }
  state_->known.insert(std::string(key));
  const ConfigNode* found = state_->map->find(std::string(key));
  if (found == nullptr && must) {
    state_->documents->problems.push_back(
        {state_->map->place, state_->path_of(key), "is missing; allowed: " + allowed});
  }
  if (found != nullptr && found->is_null()) {
    state_->documents->problems.push_back({found->place, state_->path_of(key), "has no value; allowed: " + allowed});
    return nullptr;
  }
  return found;
}

bool ConfigReader::scalar(const ConfigNode& node, const std::string& path, double& value,
                          const NumberRange& range) const {
  const auto complain = [&](const std::string& message) {
    state_->documents->problems.push_back({node.place, path, message});
    return false;
  };
  const auto found = node.is_scalar() && !node.quoted ? parse_number(node.scalar) : std::nullopt;
  if (!found) {
    return complain(described(node) + ", not " + number_text(range.lo, range.hi));
  }
  if (!std::isfinite(*found)) {
    return complain(node.scalar + " is not finite; allowed: " + number_text(range.lo, range.hi));
  }
  if (*found < range.lo || *found > range.hi) {
    return complain(node.scalar + " is outside " + range_text(range.lo, range.hi));
  }
  value = *found * range.si_per_unit;
  return true;
}

std::optional<double> ConfigReader::number(std::string_view key, bool must, const NumberRange& range) const {
  double value = 0.0;
  const ConfigNode* node = take(key, must, number_text(range.lo, range.hi));
  return node != nullptr && scalar(*node, state_->path_of(key), value, range) ? std::optional(value) : std::nullopt;
}

std::optional<std::int64_t> ConfigReader::integer(std::string_view key, bool must, const IntegerRange& range) const {
  const ConfigNode* node = take(key, must, integer_text(range.lo, range.hi));
  if (node == nullptr) {
    return std::nullopt;
  }
  const auto value = node->is_scalar() && !node->quoted ? parse_integer(node->scalar) : std::nullopt;
  if (!value) {
    problem(key, described(*node) + ", not " + integer_text(range.lo, range.hi));
    return std::nullopt;
  }
  if (*value < range.lo || *value > range.hi) {
    problem(key, node->scalar + " is outside [" + std::to_string(range.lo) + ", " + std::to_string(range.hi) + "]");
    return std::nullopt;
  }
  return value;
}

std::optional<std::uint64_t> ConfigReader::natural(std::string_view key, bool must) const {
  const std::string allowed = "a whole number from 0 to 2^64 - 1";
  const ConfigNode* node = take(key, must, allowed);
  if (node == nullptr) {
    return std::nullopt;
  }
  const auto value = node->is_scalar() && !node->quoted ? parse_natural(node->scalar) : std::nullopt;
  if (!value) {
    problem(key, described(*node) + ", not " + allowed);
  }
  return value;
}

bool ConfigReader::numbers(std::string_view key, std::span<double> values, bool must, const NumberRange& range) const {
  const std::string allowed = "a list of " + std::to_string(values.size()) + " numbers" +
                              (range_text(range.lo, range.hi).empty() ? "" : " in " + range_text(range.lo, range.hi));
  const ConfigNode* node = take(key, must, allowed);
  if (node == nullptr) {
    return false;
  }
  if (!node->is_list() || node->items.size() != values.size()) {
    const std::string what =
        node->is_list() ? "has " + std::to_string(node->items.size()) + " values" : described(*node);
    problem(key, what + ", not " + allowed);
    return false;
  }
  bool good = true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    good &= scalar(node->items[i], state_->path_of(key) + "[" + std::to_string(i) + "]", values[i], range);
  }
  return good;
}

std::optional<std::vector<double>> ConfigReader::any_numbers(std::string_view key, bool must,
                                                             const NumberRange& range) const {
  const ConfigNode* node = take(key, must, "a list of numbers");
  if (node == nullptr) {
    return std::nullopt;
  }
  if (!node->is_list()) {
    problem(key, described(*node) + ", not a list of numbers");
    return std::nullopt;
  }
  std::vector<double> values(node->items.size());
  bool good = true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    good &= scalar(node->items[i], state_->path_of(key) + "[" + std::to_string(i) + "]", values[i], range);
  }
  return good ? std::optional(std::move(values)) : std::nullopt;
}

std::optional<std::vector<double>> ConfigReader::rows(std::string_view key, std::size_t width, bool must,
                                                      const NumberRange& range) const {
  const std::string allowed = "a list of lists of " + std::to_string(width) + " numbers";
  const ConfigNode* node = take(key, must, allowed);
  if (node == nullptr) {
    return std::nullopt;
  }
  if (!node->is_list()) {
    problem(key, described(*node) + ", not " + allowed);
    return std::nullopt;
  }
  std::vector<double> values;
  bool good = true;
  for (std::size_t i = 0; i < node->items.size(); ++i) {
    const ConfigNode& row = node->items[i];
    const std::string path = state_->path_of(key) + "[" + std::to_string(i) + "]";
    if (!row.is_list() || row.items.size() != width) {
      state_->documents->problems.push_back(
          {row.place, path, "is not a list of " + std::to_string(width) + " numbers, as a place in this list must be"});
      good = false;
      continue;
    }
    for (std::size_t k = 0; k < width; ++k) {
      values.push_back(0.0);
      good &= scalar(row.items[k], path + "[" + std::to_string(k) + "]", values.back(), range);
    }
  }
  return good ? std::optional(std::move(values)) : std::nullopt;
}

void ConfigReader::read(std::string_view key, bool& value, bool must) const {
  const ConfigNode* node = take(key, must, "true, false");
  if (node == nullptr) {
    return;
  }
  if (node->is_scalar() && !node->quoted && (node->scalar == "true" || node->scalar == "false")) {
    value = node->scalar == "true";
  } else {
    problem(key, described(*node) + ", not true or false");
  }
}

void ConfigReader::read(std::string_view key, std::string& value, bool must) const {
  const ConfigNode* node = take(key, must, "text");
  if (node == nullptr) {
    return;
  }
  if (node->is_scalar()) {
    value = node->scalar;
  } else {
    problem(key, described(*node) + ", not text");
  }
}

void ConfigReader::read(std::string_view key, std::vector<std::string>& value, bool must) const {
  const ConfigNode* node = take(key, must, "a list of texts");
  if (node == nullptr) {
    return;
  }
  if (!node->is_list()) {
    problem(key, described(*node) + ", not a list of texts");
    return;
  }
  std::vector<std::string> found;
  for (std::size_t i = 0; i < node->items.size(); ++i) {
    const ConfigNode& item = node->items[i];
    if (item.is_scalar()) {
      found.push_back(item.scalar);
    } else {
      state_->documents->problems.push_back(
          {item.place, state_->path_of(key) + "[" + std::to_string(i) + "]", described(item) + ", not text"});
    }
  }
  if (found.size() == node->items.size()) {
    value = std::move(found);
  }
}

std::optional<std::size_t> ConfigReader::word(std::string_view key, const std::vector<std::string>& words,
                                              bool must) const {
  const ConfigNode* node = take(key, must, joined(words));
  if (node == nullptr) {
    return std::nullopt;
  }
  const auto found = std::find(words.begin(), words.end(), node->is_scalar() ? node->scalar : "");
  if (!node->is_scalar() || found == words.end()) {
    problem(key, described(*node) + ", not one of " + joined(words));
    return std::nullopt;
  }
  return static_cast<std::size_t>(found - words.begin());
}

void ConfigReader::read_path(std::string_view key, std::string& path, bool must) const {
  namespace fs = std::filesystem;
  const ConfigNode* node = take(key, must, "a path");
  if (node == nullptr) {
    return;
  }
  if (!node->is_scalar() || node->scalar.empty()) {
    problem(key, described(*node) + ", not a path");
    return;
  }
  std::vector<std::string> folders;
  if (node->from_command) {
    folders.emplace_back(".");
  }
  folders.push_back(fs::path(node->place.file).parent_path().string());
  const std::string found = find_data(node->scalar, folders);
  if (found.empty()) {
    problem(key,
            quoted(node->scalar) + ": no such file or folder" +
                (fs::path(node->scalar).is_absolute() ? "" : " (looked beside this file and in the data folders)"));
    return;
  }
  path = found;
}

ConfigReader ConfigReader::section(std::string_view key) const {
  static const ConfigNode kMissing;
  const ConfigNode* found = take(key, true, "a map of keys");
  return child(found != nullptr ? *found : kMissing, state_->path_of(key));
}

std::optional<ConfigReader> ConfigReader::optional_section(std::string_view key) const {
  const ConfigNode* found = take(key, false, "a map of keys");
  return found == nullptr ? std::nullopt : std::optional(child(*found, state_->path_of(key)));
}

std::vector<ConfigReader> ConfigReader::list(std::string_view key) const {
  const ConfigNode* found = take(key, false, "a list");
  std::vector<ConfigReader> readers;
  if (found == nullptr) {
    return readers;
  }
  if (!found->is_list()) {
    problem(key, described(*found) + ", not a list");
    return readers;
  }
  for (std::size_t i = 0; i < found->items.size(); ++i) {
    readers.push_back(child(found->items[i], state_->path_of(key) + "[" + std::to_string(i) + "]"));
  }
  return readers;
}

std::vector<std::pair<std::string, ConfigReader>> ConfigReader::named_sections(std::string_view key) const {
  const ConfigNode* found = take(key, false, "a map of keys");
  std::vector<std::pair<std::string, ConfigReader>> readers;
  if (found == nullptr) {
    return readers;
  }
  if (!found->is_map()) {
    problem(key, described(*found) + ", not a map of keys");
    return readers;
  }
  for (const auto& entry : found->entries) {
    readers.emplace_back(entry.key, child(entry.value, state_->path_of(key) + "." + entry.key));
  }
  return readers;
}

const ConfigNode* ConfigReader::node(std::string_view key) const {
  if (state_->map == nullptr) {
    return nullptr;
  }
  state_->known.insert(std::string(key));
  return state_->map->find(std::string(key));
}

const ConfigNode& ConfigReader::node() const {
  static const ConfigNode kMissing;
  return state_->map != nullptr ? *state_->map : kMissing;
}

bool ConfigReader::has(std::string_view key) const { return node(key) != nullptr; }

void ConfigReader::problem(std::string_view key, const std::string& message) const {
  if (state_->map == nullptr) {
    return;
  }
  const ConfigNode* found = state_->map->find(std::string(key));
  state_->documents->problems.push_back(
      {found != nullptr ? found->place : state_->map->place, state_->path_of(key), message});
}

void ConfigReader::add(const ConfigError& error) const {
  state_->documents->problems.insert(state_->documents->problems.end(), error.problems().begin(),
                                     error.problems().end());
}

bool ConfigReader::good() const { return state_->documents->problems.empty(); }

std::vector<std::string> ConfigReader::known_keys() const { return {state_->known.begin(), state_->known.end()}; }

std::size_t ConfigReader::problem_count() const { return state_->documents->problems.size(); }

void ConfigReader::finish() const {
  if (!state_->is_document) {
    return;
  }
  std::vector<ConfigProblem> problems = state_->documents->problems;
  for (const State& map : state_->documents->maps) {
    if (map.map == nullptr) {
      continue;
    }
    const std::vector<std::string> known(map.known.begin(), map.known.end());
    for (const auto& entry : map.map->entries) {
      if (map.known.count(entry.key) != 0) {
        continue;
      }
      const std::string nearest = nearest_name(entry.key, known);
      const std::string hint = known.empty()     ? ""
                               : nearest.empty() ? "; known keys: " + joined(known)
                                                 : "; did you mean " + nearest + "?";
      problems.push_back({entry.place, map.path_of(entry.key), "is not a known key" + hint});
    }
  }
  if (!problems.empty()) {
    throw ConfigError(std::move(problems));
  }
}

}  // namespace ensonify
