#pragma once

#include <cstdint>
#include <optional>
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

/// A parsed file, with the problems that the tree itself cannot show (duplicate keys).
struct ConfigDocument {
  ConfigNode root;
  std::vector<ConfigProblem> problems;
};

inline constexpr const char* kNotUtf8 = "is not UTF-8";

/// Parses one YAML document. `file` is the name that problems show. Throws ConfigError when the text is not YAML or
/// UTF-8, holds no or several documents, has a root that is not a map, or grows beyond 200000 values through its
/// aliases.
ConfigDocument parse_config(const std::string& text, const std::string& file);

/// Reads and parses a file of at most 16 MiB. Throws ConfigError, also when it cannot be read.
ConfigDocument parse_config_file(const std::string& path);

/// Parses a value as typed in `--set key=VALUE`: any YAML value, `place` given to all of it. Throws ConfigError.
ConfigNode parse_config_value(const std::string& text, const ConfigPlace& place);

/// Applies `path` (dots between keys, numbers index lists: "runlines.0.to_m") to a tree, making maps on the way.
/// Returns "" or why it cannot be done.
std::string set_config_value(ConfigNode& root, const std::string& path, ConfigNode value);

/// Compact JSON with the types that YAML 1.2 gives to plain scalars (null, true, false, numbers).
std::string to_json(const ConfigNode& node);

/// YAML in one fixed layout without places, for records: equal trees give equal bytes. A scalar that is an absolute
/// path is reduced to its last part, so no record knows on which machine it was made.
std::string to_canonical_yaml(const ConfigNode& node);

/// Values to set before reading: ("water.salinity_psu", value). Their places appear in messages.
using Overrides = std::vector<std::pair<std::string, ConfigNode>>;

/// Applies overrides to a tree; a path that leads nowhere is a problem.
std::vector<ConfigProblem> apply(const Overrides& overrides, ConfigNode& root);

/// The whole of `text` as a decimal number; infinities and NaN (".inf", ".nan", "inf", "nan") come back as such.
std::optional<double> parse_number(const std::string& text);

/// The whole of `text` as a whole number, decimal or 0x hexadecimal.
std::optional<std::int64_t> parse_integer(const std::string& text);
std::optional<std::uint64_t> parse_natural(const std::string& text);

/// What a YAML reader makes of a bare word, by its own rules or those of YAML 1.1: nothing (null, ~), a truth value
/// (true, no, on) or a text. Every spelling counts: Null, NULL, nULL.
enum class BareWord { kText, kNull, kBool };
BareWord bare_word(const std::string& text);

/// "100000", "1e+06": as %g writes it when that is exact, else with as many digits as distinguish it from its
/// neighbours.
std::string shortest_number(double value);

}  // namespace ensonify
