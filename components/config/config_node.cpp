#include "components/config/config_node.h"

#include <algorithm>
#include <charconv>

namespace ensonify {

const ConfigNode* ConfigNode::find(const std::string& key) const {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.key == key; });
  return found == entries.end() ? nullptr : &found->value;
}

ConfigNode* ConfigNode::find(const std::string& key) {
  return const_cast<ConfigNode*>(static_cast<const ConfigNode*>(this)->find(key));
}

void ConfigNode::set(const std::string& key, ConfigNode value) {
  if (kind == Kind::kNull) {
    kind = Kind::kMap;
  }
  if (ConfigNode* old = find(key)) {
    *old = std::move(value);
    return;
  }
  const ConfigPlace value_place = value.place;
  entries.push_back({key, value_place, std::move(value)});
}

ConfigNode ConfigNode::text(std::string value, ConfigPlace place) {
  ConfigNode node;
  node.kind = Kind::kScalar;
  node.scalar = std::move(value);
  node.place = std::move(place);
  return node;
}

ConfigNode ConfigNode::map(ConfigPlace place) {
  ConfigNode node;
  node.kind = Kind::kMap;
  node.place = std::move(place);
  return node;
}

namespace {

std::string set_in_list(ConfigNode& list, const std::string& first, const std::string& rest, ConfigNode value) {
  std::size_t index = 0;
  const auto end = first.data() + first.size();
  const auto parsed = std::from_chars(first.data(), end, index);
  if (parsed.ec != std::errc() || parsed.ptr != end) {
    return "\"" + first + "\" does not count the values of a list";
  }
  if (index >= list.items.size()) {
    return "the list has " + std::to_string(list.items.size()) + " values; counted from 0";
  }
  if (rest.empty()) {
    list.items[index] = std::move(value);
    return "";
  }
  return set_config_value(list.items[index], rest, std::move(value));
}

}  // namespace

std::string set_config_value(ConfigNode& root, const std::string& path, ConfigNode value) {
  const std::size_t dot = path.find('.');
  const std::string first = path.substr(0, dot);
  const std::string rest = dot == std::string::npos ? "" : path.substr(dot + 1);
  if (path.empty() || path.front() == '.' || path.back() == '.' || path.find("..") != std::string::npos) {
    return "\"" + path + "\" is not a path of keys with dots between them";
  }
  if (root.is_list()) {
    return set_in_list(root, first, rest, std::move(value));
  }
  if (root.is_scalar()) {
    return "\"" + root.scalar + "\" holds no keys";
  }
  if (rest.empty()) {
    root.set(first, std::move(value));
    return "";
  }
  if (root.find(first) == nullptr) {
    root.set(first, ConfigNode::map(value.place));
  }
  return set_config_value(*root.find(first), rest, std::move(value));
}

std::vector<ConfigProblem> apply(const Overrides& overrides, ConfigNode& root) {
  std::vector<ConfigProblem> problems;
  for (const auto& [path, value] : overrides) {
    if (const std::string why = set_config_value(root, path, value); !why.empty()) {
      problems.push_back({value.place, path, why});
    }
  }
  return problems;
}

}  // namespace ensonify
