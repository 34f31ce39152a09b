#pragma once

#include <string_view>

namespace ensonify {

/// "*" and whatever ends in it ("bow/*") are patterns; anything else is a name.
inline bool is_pattern(std::string_view topic) { return topic.ends_with('*'); }

/// Whether a name or pattern, as recorders, replays and assertions are given them, means this topic.
inline bool topic_matches(std::string_view wanted, std::string_view topic) {
  return is_pattern(wanted) ? topic.starts_with(wanted.substr(0, wanted.size() - 1)) : wanted == topic;
}

}  // namespace ensonify
