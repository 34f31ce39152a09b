#pragma once

#include <string>
#include <vector>

#include "components/config/config_node.h"

namespace ensonify {

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

}  // namespace ensonify
