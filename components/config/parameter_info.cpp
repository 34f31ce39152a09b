#include "components/config/parameter_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>

#include "components/config/config_node.h"
#include "components/config/config_text.h"
#include "components/config/scalar_text.h"

namespace ensonify {

namespace {

/// YAML reads 1e+09 as text unless it has a point.
std::string with_point(std::string number) {
  const std::size_t exponent = number.find('e');
  if (exponent != std::string::npos && number.find('.') == std::string::npos) number.insert(exponent, ".0");
  return number;
}

/// A cell may not hold a bar.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return text;
}

std::string default_text(const ParameterInfo& p, bool in_form) {
  if (p.allowed.required) return in_form ? "of its form" : "required";
  if (p.left_out) return "";
  return "`" +
         (p.value.is_scalar() ? p.value.quoted && p.value.scalar.empty() ? "\"\"" : p.value.scalar : to_json(p.value)) +
         "`";
}

/// `in_form`: the list is that of one form of several, so that nothing in it must always be there.
void add_rows(const ParameterList& list, const std::string& path, bool in_form, std::string& table) {
  using Kind = ParameterInfo::Kind;
  for (const ParameterInfo& p : list) {
    const std::string key = path + p.key;
    if (p.kind == Kind::kForms) {
      std::string rows;
      for (const ParameterList& form : p.forms) add_rows(form, path, true, rows);
      std::istringstream lines(rows);
      std::set<std::string> known;  // several forms may have a key
      for (std::string line; std::getline(lines, line);) {
        if (known.insert(line).second) table += line + "\n";
      }
    } else if (p.kind == Kind::kSection || p.kind == Kind::kList || p.kind == Kind::kNamed) {
      const std::string inner = key + (p.kind == Kind::kList    ? "[]."
                                       : p.numbered             ? ".NUMBER."
                                       : p.kind == Kind::kNamed ? ".NAME."
                                                                : ".");
      table += "| `" + key + "` | | " +
               (p.kind == Kind::kSection ? ""
                : p.entries.empty()      ? "none"
                                         : "as below") +
               " | | " + cell(p.about) + " |\n";
      add_rows(p.members, inner, false, table);
    } else {
      table += "| `" + key + "` | " + p.unit + " | " + cell(default_text(p, in_form)) + " | " + cell(allowed_text(p)) +
               " | " + cell(p.about) + " |\n";
    }
  }
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

std::string parameter_table(const ParameterList& list) {
  std::string table = "| parameter | unit | default | allowed | meaning |\n|---|---|---|---|---|\n";
  add_rows(list, "", false, table);
  return table;
}

bool lists_key(const ParameterList& list, const std::string& key) {
  return std::any_of(list.begin(), list.end(), [&](const ParameterInfo& p) {
    return p.key == key ||
           std::any_of(p.forms.begin(), p.forms.end(), [&](const ParameterList& form) { return lists_key(form, key); });
  });
}

std::string detail::absolute_path(const std::string& path) {
  return path.empty() ? path : std::filesystem::absolute(path).lexically_normal().string();
}

}  // namespace ensonify
