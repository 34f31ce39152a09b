#include "tools/topic/select.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include "components/config/config_error.h"
#include "components/errors/nearest_name.h"

namespace ensonify::topic_tool {
namespace {

UserError no_such_topic(const std::string& name, const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(name, known);
  if (!nearest.empty()) return UserError(fmt::format("{}: no such topic; did you mean {}?", name, nearest));
  return UserError(fmt::format("{}: no such topic; there are {}", name, fmt::join(known, ", ")));
}

}  // namespace

std::vector<TopicEntry> select(const RunRegistry& registry, const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const TopicEntry& topic : registry.topics) known.push_back(topic.name);
  std::vector<bool> wanted(known.size());
  for (const std::string& name : names) {
    bool found = false;
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (::fnmatch(name.c_str(), known[i].c_str(), 0) == 0) wanted[i] = found = true;
    }
    if (!found) throw no_such_topic(name, known);
  }
  std::vector<TopicEntry> selected;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (wanted[i]) selected.push_back(registry.topics[i]);
  }
  return selected;
}

}  // namespace ensonify::topic_tool
