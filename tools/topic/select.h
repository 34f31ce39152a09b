#pragma once

#include <string>
#include <vector>

#include "components/runtime/clock_client.h"

namespace ensonify::topic_tool {

/// The topics named: each of `names` is a topic or a pattern such as "bow/*". Throws UserError for one that names none,
/// with the nearest topic or, when none is near, all of them.
std::vector<TopicEntry> select(const RunRegistry& registry, const std::vector<std::string>& names);

/// "4.2 MB", "17 kB", "512 B": powers of ten, for people.
std::string bytes_text(double bytes);

/// "100 Hz", "29.97 Hz", "at most 10 Hz on average" when the rate is not declared.
std::string rate_text(Rate rate);

}  // namespace ensonify::topic_tool
