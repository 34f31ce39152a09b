#include "launch/file/tree.h"

#include <algorithm>
#include <filesystem>

#include "components/config/data_paths.h"
#include "components/config/parse_yaml.h"
#include "components/errors/nearest_name.h"
#include "components/errors/printable.h"

namespace ensonify {

namespace {

namespace fs = std::filesystem;
using Problems = std::vector<ConfigProblem>;
using Values = std::map<std::string, ConfigNode>;

const std::vector<std::string> kLater = {"out"};

std::string folder_of(const std::string& file) { return fs::path(file).parent_path().string(); }

std::string hint(const std::string& name, const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(name, known);
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

/// Bytes that are not ASCII become "?".
std::string ascii(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c >= 0x80; }, '?');
  return text;
}

/// The file's declared arguments with what was given for them.
Values arguments_of(ConfigNode& root, const Values& given, Problems& problems, bool& missing) {
  Values values;
  std::vector<std::string> declared;
  if (const ConfigNode* args = root.find("args")) {
    if (!args->is_map()) {
      problems.push_back({args->place, "args", "is not a map of arguments and their defaults"});
      return values;
    }
    for (const auto& entry : args->entries) {
      declared.push_back(entry.key);
      if (const auto found = given.find(entry.key); found != given.end()) {
        values[entry.key] = found->second;
      } else if (entry.value.is_scalar()) {
        values[entry.key] = entry.value;
      } else if (entry.value.is_null()) {
        problems.push_back({entry.place, "args." + entry.key, "must be given; use --arg " + entry.key + "=VALUE"});
        values[entry.key] = ConfigNode::text("", entry.place);
        missing = true;
      } else {
        problems.push_back({entry.place, "args." + entry.key, "has a default that is not a single value"});
      }
    }
  }
  for (const auto& [name, value] : given) {
    if (std::find(declared.begin(), declared.end(), name) == declared.end()) {
      problems.push_back(
          {value.place, "args." + name, "is not an argument of this launch file" + hint(name, declared)});
    }
  }
  return values;
}

/// Moves `from`'s entries behind those of `into`; a name in both is a problem.
void merge_map(ConfigNode& into, ConfigNode from, const std::string& key, Problems& problems) {
  if (into.is_null()) {
    into = std::move(from);
    return;
  }
  if (!into.is_map() || !from.is_map()) {
    const ConfigNode& wrong = into.is_map() ? from : into;
    problems.push_back({wrong.place, key, "is not a map of keys"});
    return;
  }
  for (auto& entry : from.entries) {
    if (const ConfigNode* first = into.find(entry.key)) {
      problems.push_back({entry.place, key + "." + entry.key,
                          "is given twice, first at " + first->place.file + ":" + std::to_string(first->place.line)});
      continue;
    }
    into.entries.push_back(std::move(entry));
  }
}

void merge_list(ConfigNode& into, ConfigNode from) {
  if (!into.is_list() || !from.is_list()) {
    into = std::move(from);
    return;
  }
  for (auto& item : from.items) {
    into.items.push_back(std::move(item));
  }
}

/// Puts an includer's keys over what its includes gave.
void merge(ConfigNode& into, ConfigNode from, Problems& problems) {
  static const std::vector<std::string> kMaps = {"processes", "wiring"};
  static const std::vector<std::string> kLists = {"expect", "after"};
  for (auto& entry : from.entries) {
    if (entry.key == "wiring" && entry.value.is_null()) continue;  // all of it is commented out
    ConfigNode* old = into.find(entry.key);
    if (old == nullptr) {
      into.entries.push_back(std::move(entry));
    } else if (std::find(kMaps.begin(), kMaps.end(), entry.key) != kMaps.end()) {
      merge_map(*old, std::move(entry.value), entry.key, problems);
    } else if (std::find(kLists.begin(), kLists.end(), entry.key) != kLists.end()) {
      merge_list(*old, std::move(entry.value));
    } else if (entry.key == "set" && old->is_map() && entry.value.is_map()) {
      for (auto& value : entry.value.entries) {
        old->set(value.key, std::move(value.value));
      }
    } else {
      *old = std::move(entry.value);
    }
  }
  into.place = from.place;
}

class Loader {
 public:
  Problems problems;
  bool argument_missing = false;

  ConfigNode load(const std::string& file, const Values& given) {
    ConfigDocument document = parse_config_file(file);
    problems.insert(problems.end(), document.problems.begin(), document.problems.end());
    ConfigNode root = std::move(document.root);
    const Values values = arguments_of(root, given, problems, argument_missing);
    remove(root, "args");
    substitute(root, values, kLater, problems);
    const ConfigNode include = remove(root, "include");
    open_.push_back(fs::weakly_canonical(file).string());
    ConfigNode merged = ConfigNode::map(root.place);
    if (include.is_list()) {
      for (const auto& item : include.items) {
        merge(merged, included(item, file), problems);
      }
    } else if (!include.is_null()) {
      merge(merged, included(include, file), problems);
    }
    open_.pop_back();
    merge(merged, std::move(root), problems);
    return merged;
  }

 private:
  static ConfigNode remove(ConfigNode& root, const std::string& key) {
    ConfigNode value;
    for (auto entry = root.entries.begin(); entry != root.entries.end(); ++entry) {
      if (entry->key == key) {
        value = std::move(entry->value);
        root.entries.erase(entry);
        break;
      }
    }
    return value;
  }

  /// `other.yaml`, or `{file: other.yaml, args: {name: value}}`.
  ConfigNode included(const ConfigNode& item, const std::string& includer) {
    const ConfigNode* name = item.is_map() ? item.find("file") : &item;
    if (name == nullptr || !name->is_scalar()) {
      problems.push_back({item.place, "include", "is neither a file nor {file, args}"});
      return ConfigNode::map();
    }
    Values given;
    if (const ConfigNode* args = item.find("args")) {
      for (const auto& entry : args->entries) {
        given[entry.key] = entry.value;
      }
    }
    const std::string file = find_data(name->scalar, {folder_of(includer)});
    if (file.empty()) {
      problems.push_back({name->place, "include", "\"" + name->scalar + "\": no such file"});
      return ConfigNode::map();
    }
    if (std::find(open_.begin(), open_.end(), fs::weakly_canonical(file).string()) != open_.end()) {
      problems.push_back(
          {name->place, "include", "\"" + name->scalar + "\" includes itself, directly or through others"});
      return ConfigNode::map();
    }
    try {
      ConfigNode root = load(file, given);
      check_format(root, file);
      return root;
    } catch (const ConfigError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
      return ConfigNode::map();
    }
  }

  void check_format(ConfigNode& root, const std::string& file) {
    const ConfigNode format = remove(root, "ensonify");
    if (format.scalar != kLaunchFormat) {
      const ConfigPlace place = format.is_scalar() ? format.place : ConfigPlace{file, 1, 1};
      const std::string what = format.is_scalar() ? format.scalar + " is not a format known here" : "is missing";
      problems.push_back({place, "ensonify", what + "; allowed: " + kLaunchFormat});
    }
  }

  std::vector<std::string> open_;  // files being read, outermost first
};

const std::vector<std::string> kScenarioSections = {"site",    "time",   "seed",    "water",    "vertical",
                                                    "current", "seabed", "objects", "vehicles", "mission"};

}  // namespace

std::optional<std::pair<std::string, std::string>> split_assignment(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    return std::nullopt;
  }
  return std::pair{text.substr(0, equals), text.substr(equals + 1)};
}

void substitute(ConfigNode& node, const std::map<std::string, ConfigNode>& values,
                const std::vector<std::string>& later, std::vector<ConfigProblem>& problems) {
  for (auto& item : node.items) {
    substitute(item, values, later, problems);
  }
  for (auto& entry : node.entries) {
    substitute(entry.value, values, later, problems);
  }
  std::size_t from = 0;
  while (node.is_scalar() && (from = node.scalar.find("$(", from)) != std::string::npos) {
    const std::size_t end = node.scalar.find(')', from);
    if (end == std::string::npos) {
      problems.push_back({node.place, "", "\"" + node.scalar + "\": $( is not closed"});
      return;
    }
    const std::string name = node.scalar.substr(from + 2, end - from - 2);
    if (const auto found = values.find(name); found != values.end()) {
      node.scalar.replace(from, end + 1 - from, found->second.scalar);
      from += found->second.scalar.size();  // what was put in is not searched again
      node.from_command |= found->second.from_command;
    } else if (std::find(later.begin(), later.end(), name) != later.end()) {
      from = end + 1;
    } else {
      std::vector<std::string> known = later;
      for (const auto& value : values) {
        known.push_back(value.first);
      }
      problems.push_back({node.place, "", "$(" + name + ") is not declared under args" + hint(name, known)});
      from = end + 1;
    }
  }
}

ConfigDocument load_launch_tree(const std::string& file, const std::vector<std::string>& args) {
  Loader loader;
  Values given;
  for (const auto& arg : args) {
    if (!is_utf8(arg)) {
      loader.problems.push_back({{"--arg " + ascii(arg)}, "", kNotUtf8});
    } else if (const auto assignment = split_assignment(arg)) {
      ConfigNode value = ConfigNode::text(assignment->second, {"--arg " + assignment->first});
      value.from_command = true;
      given[assignment->first] = value;
    } else {
      loader.problems.push_back({{"--arg " + arg}, "", "is not NAME=VALUE"});
    }
  }
  ConfigNode root = loader.load(file, given);
  if (loader.argument_missing) {  // all else would follow from it
    throw ConfigError(std::move(loader.problems));
  }
  return {std::move(root), std::move(loader.problems)};
}

bool is_scenario_section(const std::string& name) {
  return std::find(kScenarioSections.begin(), kScenarioSections.end(), name) != kScenarioSections.end();
}

Overrides overrides_of(const ConfigNode& root, const std::vector<std::string>& sets,
                       std::vector<ConfigProblem>& problems) {
  Overrides overrides;
  if (const ConfigNode* set = root.find("set")) {
    for (const auto& entry : set->entries) {
      overrides.emplace_back(entry.key, entry.value);
    }
    if (!set->is_map() && !set->is_null()) {
      problems.push_back({set->place, "set", "is not a map from PROCESS.KEY to a value"});
    }
  }
  for (const auto& text : sets) {
    if (!is_utf8(text)) {
      problems.push_back({{"--set " + ascii(text)}, "", kNotUtf8});
      continue;
    }
    const auto assignment = split_assignment(text);
    const ConfigPlace place{"--set " + (assignment ? assignment->first : text)};
    if (!assignment) {
      problems.push_back({place, "", "is not KEY=VALUE"});
      continue;
    }
    try {
      overrides.emplace_back(assignment->first, parse_config_value(assignment->second, place));
    } catch (const ConfigError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  return overrides;
}

OverrideTargets sort_overrides(const Overrides& overrides, const ConfigNode& root,
                               std::vector<ConfigProblem>& problems) {
  std::vector<std::string> known = kScenarioSections;
  known.emplace_back("clock");
  known.emplace_back("isa");
  const ConfigNode* processes = root.find("processes");
  if (processes != nullptr) {
    for (const auto& entry : processes->entries) {
      known.push_back(entry.key);
    }
  }
  OverrideTargets targets;
  for (const auto& [path, value] : overrides) {
    const std::size_t dot = path.find('.');
    const std::string first = path.substr(0, dot);
    const std::string rest = dot == std::string::npos ? "" : path.substr(dot + 1);
    if (path == "isa") {
      targets.launch.emplace_back(path, value);
    } else if (is_scenario_section(first)) {
      targets.scenario.emplace_back(path, value);
    } else if (rest.empty() && std::find(known.begin(), known.end(), first) != known.end()) {
      problems.push_back({value.place, "set." + path, "names no key of " + first + "; allowed: " + first + ".KEY"});
    } else if (first == "clock") {
      targets.clock.emplace_back(rest, value);
    } else if (processes != nullptr && processes->find(first) != nullptr) {
      targets.processes[first].emplace_back(rest, value);
    } else {
      const std::string nearest = nearest_name(first, known);
      problems.push_back(
          {value.place, "set." + path,
           "names no process, scenario section or clock" + (nearest.empty() ? "" : "; did you mean " + nearest + "?")});
    }
  }
  return targets;
}

}  // namespace ensonify
