#pragma once

#include <string>

#include "components/config/config_node.h"
#include "launch/file/launch_file.h"

namespace ensonify {

/// The launch file with its includes merged (theirs first) and its arguments put in; `$(out)` is left for later.
/// Problems found on the way are in the document.
ConfigDocument load_launch_tree(const std::string& file, const std::vector<std::string>& args);

/// Replaces `$(name)` in every scalar by `values`; names in `later` stay. Unknown names are problems.
void substitute(ConfigNode& node, const std::map<std::string, ConfigNode>& values,
                const std::vector<std::string>& later, std::vector<ConfigProblem>& problems);

/// Splits "a.b=v" at its first "="; nothing when there is none or the left side is empty.
std::optional<std::pair<std::string, std::string>> split_assignment(const std::string& text);

}  // namespace ensonify
