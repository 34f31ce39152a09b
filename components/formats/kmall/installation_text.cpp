#include "components/formats/kmall/installation_text.h"

#include <algorithm>

namespace ensonify::formats::kmall {

namespace {

/// Takes the piece before `mark` from the front of a text.
std::string_view take(std::string_view& text, char mark) {
  const std::string_view piece = text.substr(0, text.find(mark));
  text.remove_prefix(std::min(piece.size() + 1, text.size()));
  return piece;
}

}  // namespace

std::vector<InstallationGroup> installation_groups(std::string_view text) {
  std::vector<InstallationGroup> groups;
  while (!text.empty()) {
    std::string_view group = take(text, ',');
    while (!group.empty() && (group.front() == '\n' || group.front() == '\r' || group.front() == ' '))
      group.remove_prefix(1);
    if (group.find(':') == std::string_view::npos) continue;
    const std::string_view name = take(group, ':');
    InstallationGroup& added = groups.emplace_back();
    added.name = name;
    added.text = group;
    while (!group.empty()) {
      std::string_view value = take(group, ';');
      if (value.find('=') == std::string_view::npos) continue;
      const std::string_view key = take(value, '=');
      added.values.emplace_back(key, value);
    }
  }
  return groups;
}

}  // namespace ensonify::formats::kmall
