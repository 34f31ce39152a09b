#pragma once

#include <string>
#include <vector>

#include "components/runtime/clock_client.h"

namespace ensonify::topic_tool {

/// The topics named: each of `names` is a topic or a pattern such as "bow/*". Throws UserError for one that names none,
/// with the nearest topic or, when none is near, all of them.
std::vector<TopicEntry> select(const RunRegistry& registry, const std::vector<std::string>& names);

}  // namespace ensonify::topic_tool
