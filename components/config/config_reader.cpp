#include "components/config/config_reader.h"

#include <algorithm>
#include <cstdlib>

#include "components/config/parse_yaml.h"
#include "components/config/reader_state.h"
#include "components/errors/nearest_name.h"

namespace ensonify {

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

ConfigReader ConfigReader::child(const ConfigNode& node, const std::string& path, std::string_view short_key) const {
  if (node.is_scalar() && !short_key.empty()) {
    ConfigNode map = ConfigNode::map(node.place);
    map.set(std::string(short_key), node);
    State& state = state_->documents->open({std::move(map), {}}, path, false);
    state.short_key = short_key;
    return ConfigReader(std::shared_ptr<State>(state_, &state));
  }
  if (!node.is_map()) {
    const std::string allowed = node.is_null() ? "; allowed: a map of keys" : ", not a map of keys";
    state_->documents->problems.push_back({node.place, path, described(node) + allowed});
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

ConfigReader ConfigReader::section(std::string_view key) const {
  if (const ConfigNode* found = take(key, true, "a map of keys")) return child(*found, state_->path_of(key));
  auto& maps = state_->documents->maps;
  maps.push_back({state_->documents, nullptr, state_->path_of(key)});
  return ConfigReader(std::shared_ptr<State>(state_, &maps.back()));
}

std::optional<ConfigReader> ConfigReader::optional_section(std::string_view key, std::string_view short_key) const {
  const ConfigNode* found = take(key, false, "a map of keys");
  return found == nullptr ? std::nullopt : std::optional(child(*found, state_->path_of(key), short_key));
}

std::vector<ConfigReader> ConfigReader::list(std::string_view key, std::string_view short_key) const {
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
    readers.push_back(child(found->items[i], state_->path_of(key) + "[" + std::to_string(i) + "]", short_key));
  }
  return readers;
}

std::vector<std::pair<std::string, ConfigReader>> ConfigReader::named_sections(std::string_view key,
                                                                               std::string_view short_key) const {
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
    ConfigNode none;
    none.place = entry.place;  // nothing has the place of what follows it
    const ConfigNode& value = entry.value.is_null() ? none : entry.value;
    readers.emplace_back(entry.key, child(value, state_->path_of(key) + "." + entry.key, short_key));
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

bool ConfigReader::holds_word(std::string_view key, const std::string& word) const {
  const ConfigNode* found = node(key);
  return found != nullptr && found->is_scalar() && found->scalar == word;
}

namespace {

/// The value at "channels[1].name", or what stands nearest above it.
const ConfigNode& nearest_node(const ConfigNode& map, std::string_view path) {
  const ConfigNode* node = &map;
  while (!path.empty()) {
    const std::size_t end = std::min(path.find_first_of(".[", 1), path.size());
    const std::string word(path.substr(0, end));
    path.remove_prefix(end < path.size() && path[end] == '.' ? end + 1 : end);
    const ConfigNode* inner = nullptr;
    if (word.front() == '[') {
      const std::size_t index = std::strtoul(word.c_str() + 1, nullptr, 10);
      inner = node->is_list() && index < node->items.size() ? &node->items[index] : nullptr;
    } else {
      inner = node->find(word);
    }
    if (inner == nullptr) break;
    node = inner;
  }
  return *node;
}

}  // namespace

void ConfigReader::problem(std::string_view key, const std::string& message) const {
  if (state_->map == nullptr) {
    return;
  }
  state_->documents->problems.push_back(problem_at(key, message));
}

ConfigProblem ConfigReader::problem_at(std::string_view key, const std::string& message) const {
  return {nearest_node(node(), key).place, state_->path_of(key), message};
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

void read_format(ConfigReader& from, const std::string& known_format) {
  std::string format;
  from.required("ensonify", format);
  if (!format.empty() && format != known_format) {
    from.problem("ensonify", format + " is not a format known here; allowed: " + known_format);
  }
}

}  // namespace ensonify
