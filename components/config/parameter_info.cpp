#include "components/config/parameter_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "components/config/config_node.h"

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

std::string default_text(const ParameterInfo& p) {
  if (p.allowed.required) return "required";
  if (p.left_out) return "";
  return "`" +
         (p.value.is_scalar() ? p.value.quoted && p.value.scalar.empty() ? "\"\"" : p.value.scalar : to_json(p.value)) +
         "`";
}

void add_rows(const ParameterList& list, const std::string& path, std::string& table) {
  using Kind = ParameterInfo::Kind;
  for (const ParameterInfo& p : list) {
    const std::string key = path + p.key;
    if (p.kind == Kind::kSection || p.kind == Kind::kList || p.kind == Kind::kNamed) {
      const std::string inner = key + (p.kind == Kind::kList ? "[]." : p.kind == Kind::kNamed ? ".NAME." : ".");
      table += "| `" + key + "` | | " +
               (p.kind == Kind::kSection ? ""
                : p.entries.empty()      ? "none"
                                         : "as below") +
               " | | " + cell(p.about) + " |\n";
      add_rows(p.members, inner, table);
    } else {
      table += "| `" + key + "` | " + p.unit + " | " + cell(default_text(p)) + " | " + cell(allowed_text(p)) + " | " +
               cell(p.about) + " |\n";
    }
  }
}

using Json = nlohmann::ordered_json;
using Kind = ParameterInfo::Kind;

Json object_of(const ParameterList& list);

Json number(const Allowed& allowed) {
  Json json = {{"type", "number"}};
  if (allowed.lo > -Allowed::kHighest) json["minimum"] = allowed.lo;
  if (allowed.hi < Allowed::kHighest) json["maximum"] = allowed.hi;
  return json;
}

Json list_of(Json items, std::size_t width) {
  Json json = {{"type", "array"}, {"items", std::move(items)}};
  if (width > 0) json["minItems"] = json["maxItems"] = width;
  return json;
}

Json type_of(const ParameterInfo& p) {
  switch (p.kind) {
    case Kind::kNumber: return number(p.allowed);
    case Kind::kInteger: {
      Json json = number(p.allowed);
      json["type"] = "integer";
      return json;
    }
    case Kind::kBool: return {{"type", "boolean"}};
    case Kind::kText:
      if (p.allowed.text == Allowed::Text::kPath) return {{"type", "string"}};  // a launch may fill in an empty one
      return p.allowed.text == Allowed::Text::kAny ? Json{{"type", {"string", "number", "boolean"}}}
                                                   : Json{{"type", "string"}, {"minLength", 1}};
    case Kind::kWord: {
      Json words = Json::array();
      for (const Word& word : p.allowed.words) words.push_back(word.text);
      return {{"enum", words}};
    }
    case Kind::kNumbers: return list_of(number(p.allowed), p.width);
    case Kind::kRows: return list_of(list_of(number(p.allowed), p.width), 0);
    case Kind::kTexts: return list_of({{"type", "string"}}, 0);
    case Kind::kSection: return object_of(p.members);
    case Kind::kList: return list_of(object_of(p.members), 0);
    case Kind::kOther: return Json::parse(p.schema);
    case Kind::kNamed: return {{"type", "object"}, {"additionalProperties", object_of(p.members)}};
  }
  return {};
}

Json object_of(const ParameterList& list) {
  Json properties = Json::object(), required = Json::array();
  for (const ParameterInfo& p : list) {
    Json& json = properties[p.key] = type_of(p);
    const bool in_si_text = p.unit.empty();
    json["description"] = p.about + (in_si_text ? "" : " (" + p.unit + ")");
    const bool structure = p.kind == Kind::kSection || p.kind == Kind::kList || p.kind == Kind::kNamed;
    if (!structure && !p.left_out) json["default"] = Json::parse(to_json(p.value));
    if (p.allowed.required) required.push_back(p.key);
  }
  Json json = {{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
  if (!required.empty()) json["required"] = std::move(required);
  return json;
}

constexpr std::size_t kFarthestComment = 36;  // column

struct Line {
  std::string text;
  std::string about;
};

bool reads_as_text(const std::string& text) {
  static const std::string kSafe = "_-./";
  const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || kSafe.find(static_cast<char>(c)) < 4; };
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) != 0 &&
         std::all_of(text.begin(), text.end(), plain) && text != "true" && text != "false" && text != "null";
}

std::string flow_text(const ConfigNode& node) {
  if (node.is_list()) {
    std::string text;
    for (const ConfigNode& item : node.items) text += (text.empty() ? "" : ", ") + flow_text(item);
    return "[" + text + "]";
  }
  if (node.is_map()) return to_json(node);
  return node.quoted && !reads_as_text(node.scalar) ? to_json(node) : node.scalar;
}

std::string comment_of(const ParameterInfo& p) {
  std::string text = p.about;
  if (const std::string allowed = allowed_text(p); !allowed.empty()) text += (text.empty() ? "" : "; ") + allowed;
  if (p.allowed.required) text += "; must be given";
  return text;
}

class YamlWriter {
 public:
  /// `given`: the list has values, not defaults. `lead` is the margin of the first line.
  void write(const ParameterList& list, bool given, const std::string& lead, const std::string& margin) {
    for (const ParameterInfo& p : list) write(p, given, &p == list.data() ? lead : margin, margin);
  }

  std::string text() const {
    std::size_t column = 0;
    for (const Line& line : lines_) {
      if (line.text.size() <= kFarthestComment) column = std::max(column, line.text.size());
    }
    std::string text;
    for (const Line& line : lines_) {
      text += line.text;
      if (!line.about.empty()) {
        text += std::string(column > line.text.size() ? column - line.text.size() : 0, ' ') + "  # " + line.about;
      }
      text += '\n';
    }
    return text;
  }

 private:
  using Kind = ParameterInfo::Kind;

  void write(const ParameterInfo& p, bool given, const std::string& lead, const std::string& margin) {
    if (p.kind == Kind::kSection || p.kind == Kind::kList || p.kind == Kind::kNamed) {
      write_structure(p, lead, margin);
    } else if (p.left_out && !(given && p.allowed.required)) {
      lines_.push_back({commented(lead) + p.key + ":", comment_of(p)});
    } else {
      lines_.push_back({lead + p.key + ": " + flow_text(p.value), comment_of(p)});
    }
  }

  void write_structure(const ParameterInfo& p, const std::string& lead, const std::string& margin) {
    const std::string inner = margin + "  ";
    if (p.kind == Kind::kSection) {
      lines_.push_back({(p.left_out ? commented(lead) : lead) + p.key + ":", comment_of(p)});
      const std::string to = p.left_out ? commented(inner) : inner;
      write(p.members, false, to, to);
    } else if (!p.entries.empty()) {
      lines_.push_back({lead + p.key + ":", comment_of(p)});
      for (const auto& [name, entry] : p.entries) {
        if (p.kind == Kind::kNamed) {
          lines_.push_back({inner + name + ":", ""});
          write(entry, true, inner + "  ", inner + "  ");
        } else {
          write(entry, true, inner + "- ", inner + "  ");
        }
      }
    } else {
      lines_.push_back({lead + p.key + (p.kind == Kind::kNamed ? ": {}" : ": []"), comment_of(p)});
      const std::string to = commented(inner);
      if (p.kind == Kind::kNamed) lines_.push_back({to + "NAME:", ""});
      write(p.members, true, to + (p.kind == Kind::kNamed ? "  " : "- "), to + "  ");
    }
  }

  static std::string commented(const std::string& margin) { return margin.starts_with("#") ? margin : "# " + margin; }

  std::vector<Line> lines_;
};

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

std::string parameter_table(const ParameterList& list) {
  std::string table = "| parameter | unit | default | allowed | meaning |\n|---|---|---|---|---|\n";
  add_rows(list, "", table);
  return table;
}

std::string object_schema(const ParameterList& list) { return object_of(list).dump(); }

std::string parameter_schema(const std::string& title, const ParameterList& list) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  schema.update(object_of(list));
  return schema.dump(2) + "\n";
}

std::string default_yaml(const std::string& title, const ParameterList& list) {
  YamlWriter writer;
  writer.write(list, false, "", "");
  return "# " + title + "\n" + writer.text();
}

}  // namespace ensonify
