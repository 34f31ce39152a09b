#include "components/config/parameter_info.h"

#include <fmt/format.h>

#include <cstdlib>

#include "components/config/scalars.h"

namespace ensonify {
namespace {

/// YAML reads 1e+09 as text unless it has a point.
std::string with_point(std::string number) {
  const std::size_t exponent = number.find('e');
  if (exponent != std::string::npos && number.find('.') == std::string::npos) number.insert(exponent, ".0");
  return number;
}

}  // namespace

ConfigNode detail::number_node(double value, double si_per_unit) {
  const double in_file = value / si_per_unit;
  std::string text;
  for (int digits = 1; digits <= 17; ++digits) {
    text = fmt::format("{:.{}g}", in_file, digits);
    if (std::strtod(text.c_str(), nullptr) * si_per_unit == value) break;
  }
  return ConfigNode::text(with_point(shortest_number(std::strtod(text.c_str(), nullptr))));
}

ConfigNode detail::text_node(const std::string& text) {
  ConfigNode node = ConfigNode::text(text);
  node.quoted = true;
  return node;
}

ConfigNode detail::list_node() {
  ConfigNode node;
  node.kind = ConfigNode::Kind::kList;
  return node;
}

namespace {

ParameterInfo structure(ParameterInfo::Kind kind, const std::string& key, const std::string& about,
                        ParameterList members, bool required) {
  ParameterInfo info{.key = key, .about = about, .kind = kind, .left_out = true, .members = std::move(members)};
  info.allowed.required = required;
  return info;
}

}  // namespace

ParameterInfo section_info(const std::string& key, const std::string& about, ParameterList members, bool required) {
  return structure(ParameterInfo::Kind::kSection, key, about, std::move(members), required);
}

ParameterInfo list_info(const std::string& key, const std::string& about, ParameterList members) {
  return structure(ParameterInfo::Kind::kList, key, about, std::move(members), false);
}

ParameterInfo named_info(const std::string& key, const std::string& about, ParameterList members) {
  return structure(ParameterInfo::Kind::kNamed, key, about, std::move(members), false);
}

ParameterInfo other_info(const std::string& key, const std::string& about, std::string schema, bool required) {
  ParameterInfo info = structure(ParameterInfo::Kind::kOther, key, about, {}, required);
  info.schema = std::move(schema);
  return info;
}

std::string allowed_text(const ParameterInfo& parameter) {
  const Allowed& allowed = parameter.allowed;
  if (!allowed.words.empty()) {
    std::string text = allowed.words.front().text;
    for (std::size_t i = 1; i < allowed.words.size(); ++i) {
      text += (i + 1 < allowed.words.size() ? ", " : " or ") + allowed.words[i].text;
    }
    return text;
  }
  return allowed.bounded() ? shortest_number(allowed.lo) + " to " + shortest_number(allowed.hi) : "";
}

}  // namespace ensonify
