#pragma once

#include <string>
#include <utility>
#include <vector>

#include "components/config/config_error.h"

namespace ensonify {

/// A value of a YAML document with its place: what ConfigReader reads from, and what launch files pass on unread
/// (expectations, inline configurations). Scalars stay text until somebody asks for a type.
struct ConfigNode {
  enum class Kind { kNull, kScalar, kList, kMap };

  Kind kind = Kind::kNull;
  std::string scalar;         // kScalar: the text without quotes
  bool quoted = false;        // kScalar: was quoted, hence never a number or a bool
  bool from_command = false;  // holds text typed on the command line; relative paths then start at the working folder
  ConfigPlace place;
  std::vector<ConfigNode> items;  // kList
  struct Entry;
  std::vector<Entry> entries;  // kMap, in the order of the file

  bool is_null() const { return kind == Kind::kNull; }
  bool is_scalar() const { return kind == Kind::kScalar; }
  bool is_list() const { return kind == Kind::kList; }
  bool is_map() const { return kind == Kind::kMap; }

  /// The value of `key` in a map, or nullptr.
  const ConfigNode* find(const std::string& key) const;
  ConfigNode* find(const std::string& key);
  /// Sets `key` of a map (a null becomes a map first), replacing an earlier value in its old order.
  void set(const std::string& key, ConfigNode value);

  static ConfigNode text(std::string value, ConfigPlace place = {});
  static ConfigNode map(ConfigPlace place = {});
};

struct ConfigNode::Entry {
  std::string key;
  ConfigPlace place;  // of the key
  ConfigNode value;
};

/// Applies `path` (dots between keys, numbers index lists: "runlines.0.to_m") to a tree, making maps on the way.
/// Returns "" or why it cannot be done.
std::string set_config_value(ConfigNode& root, const std::string& path, ConfigNode value);

/// Values to set before reading: ("water.salinity_psu", value). Their places appear in messages.
using Overrides = std::vector<std::pair<std::string, ConfigNode>>;

/// Applies overrides to a tree; a path that leads nowhere is a problem.
std::vector<ConfigProblem> apply(const Overrides& overrides, ConfigNode& root);

}  // namespace ensonify
