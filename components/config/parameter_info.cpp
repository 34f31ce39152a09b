#include "components/config/parameter_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

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
    if (p.kind == Kind::kForms) {
      for (const ParameterList& form : p.forms) add_rows(form, path, table);
    } else if (p.kind == Kind::kSection || p.kind == Kind::kList || p.kind == Kind::kNamed) {
      const std::string inner = key + (p.kind == Kind::kList      ? "[]."
                                       : p.numbered              ? ".NUMBER."
                                       : p.kind == Kind::kNamed ? ".NAME."
                                                                : ".");
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

Json type_of(const ParameterInfo& p);

/// A map with these keys, or what is short for it.
Json structure_of(const ParameterInfo& p) {
  Json map = object_of(p.members);
  const auto inner = std::find_if(p.members.begin(), p.members.end(), [&](const auto& m) { return m.key == p.short_key; });
  if (p.short_key.empty()) return map;
  if (inner != p.members.end()) return {{"anyOf", {type_of(*inner), std::move(map)}}};
  for (const ParameterInfo& forms : p.members) {  // of one of the forms
    for (const ParameterList& form : forms.forms) {
      if (!form.empty() && form.front().key == p.short_key) return {{"anyOf", {type_of(form.front()), std::move(map)}}};
    }
  }
  return map;
}

Json plain_type_of(const ParameterInfo& p) {
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
    case Kind::kWholes: {
      Json json = number(p.allowed);
      json["type"] = "integer";
      return list_of(std::move(json), 0);
    }
    case Kind::kRows: return list_of(list_of(number(p.allowed), p.width), 0);
    case Kind::kTexts: return list_of({{"type", "string"}}, 0);
    case Kind::kSection: return structure_of(p);
    case Kind::kList: return list_of(structure_of(p), 0);
    case Kind::kOther: return Json::parse(p.schema);
    case Kind::kNamed: {
      Json json = {{"type", "object"}};
      if (p.numbered) json["propertyNames"] = {{"pattern", "^[0-9]+$"}};
      json["additionalProperties"] = structure_of(p);
      return json;
    }
    case Kind::kForms: break;
  }
  return {};
}

Json type_of(const ParameterInfo& p) {
  if (p.allowed.instead.empty()) return plain_type_of(p);
  return {{"anyOf", {Json{{"const", p.allowed.instead}}, plain_type_of(p)}}};
}

bool is_structure(const ParameterInfo& p) {
  return p.kind == Kind::kSection || p.kind == Kind::kList || p.kind == Kind::kNamed;
}

void add_properties(const ParameterList& list, Json& properties, Json& required) {
  for (const ParameterInfo& p : list) {
    if (p.kind == Kind::kForms) {
      Json of_forms;  // which of them are required, the form says
      for (const ParameterList& form : p.forms) add_properties(form, properties, of_forms);
      continue;
    }
    if (p.allowed.required) required.push_back(p.key);
    if (properties.contains(p.key)) continue;
    Json& json = properties[p.key] = type_of(p);
    json["description"] = p.about + (p.unit.empty() ? "" : " (" + p.unit + ")");
    if (!is_structure(p) && !p.left_out) json["default"] = Json::parse(to_json(p.value));
  }
}

bool has_key(const ParameterList& list, const std::string& key) {
  return std::any_of(list.begin(), list.end(), [&](const ParameterInfo& p) { return p.key == key; });
}

/// Exactly one of the forms that stand among other keys: those that it must have, and none of another's.
Json one_of(const ParameterInfo& p, const ParameterList& list) {
  const auto word = std::find_if(list.begin(), list.end(), [&](const auto& key) { return key.key == p.by; });
  Json forms = Json::array();
  for (std::size_t i = 0; i < p.forms.size(); ++i) {
    const ParameterList& own = p.forms[i];
    const bool by_word = !p.by.empty(), keyless = by_word || (p.last_has_no_key && i + 1 == p.forms.size());
    Json form = Json::object(), required = Json::array();
    if (by_word) form["properties"][p.by] = {{"const", word->allowed.words[i].text}};
    if (!keyless) required.push_back(own.front().key);
    for (const ParameterInfo& key : own) {
      if (key.allowed.required && (keyless || &key != own.data())) required.push_back(key.key);
    }
    if (!required.empty()) form["required"] = std::move(required);
    for (const ParameterList& other : p.forms) {
      for (const ParameterInfo& key : other) {
        // Two forms' first keys fit no one form.
        if (!has_key(own, key.key) && (keyless || &key != other.data())) form["properties"][key.key] = false;
      }
    }
    forms.push_back(std::move(form));
  }
  return forms;
}

Json object_of(const ParameterList& list) {
  if (list.size() == 1 && list.front().kind == Kind::kForms) {
    Json forms = Json::array();
    for (const ParameterList& form : list.front().forms) forms.push_back(object_of(form));
    return {{"anyOf", std::move(forms)}};
  }
  Json properties = Json::object(), required = Json::array(), choices = Json::array();
  add_properties(list, properties, required);
  for (const ParameterInfo& p : list) {
    if (p.kind == Kind::kForms) choices.push_back({{"oneOf", one_of(p, list)}});
  }
  Json json = {{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
  if (!required.empty()) json["required"] = std::move(required);
  if (choices.size() == 1) json.update(choices.front());
  if (choices.size() > 1) json["allOf"] = std::move(choices);
  return json;
}

/// What stands in several places of a schema stands once, under `$defs`. A schema's description and default stay where
/// it is used.
class SharedSchemas {
 public:
  /// The schema with references in place of what is there more than once.
  Json shared(Json schema) {
    const Json own = schema.value("$defs", Json::object());
    schema.erase("$defs");
    std::vector<std::size_t> numbers;
    for (const auto& [name, of] : own.items()) {
      numbers.push_back(number_of(of, name));
      Part& part = parts_[numbers.back()];
      if (part.reference.empty()) part.reference = "#/$defs/" + name;
      defs_[name] = {{"$ref", part.reference}};  // until it is written
    }
    Json result = expanded(parts_[number_of(schema, "schema")].shallow);
    std::size_t next = 0;
    for (const auto& [name, of] : own.items()) {
      const Part& part = parts_[numbers[next++]];
      if (part.reference == "#/$defs/" + name) defs_[name] = expanded(part.shallow);
    }
    if (!defs_.empty()) result["$defs"] = defs_;
    return result;
  }

 private:
  struct Part {
    Json shallow;  // parts within are {"$part": number}
    std::string name;
    int uses = 0;
    std::string reference = {};
  };
  static constexpr std::size_t kShortest = 60;  // what is shorter is not worth a reference

  /// The number of equal parts is the same. `name` is that of the first place where the part stands.
  std::size_t number_of(const Json& schema, const std::string& name) {
    Json core = Json::object(), said = Json::object();
    for (const auto& [key, value] : schema.items()) {
      const bool says = (key == "description" || key == "default") && schema.size() > 1;
      (says ? said : core)[key] = with_numbers(key, value, name);
    }
    const std::size_t number = numbered(std::move(core), name);
    if (said.empty()) return number;
    said["$part"] = number;
    return numbered(std::move(said), name);
  }

  Json with_numbers(const std::string& key, const Json& value, const std::string& name) {
    const bool map = key == "properties" || key == "$defs";
    const bool list = key == "anyOf" || key == "oneOf" || key == "allOf";
    const bool one = key == "items" || key == "additionalProperties" || key == "then" || key == "if" || key == "not";
    Json result = value;
    if (map) {
      for (const auto& [inner, of] : value.items()) result[inner] = part(of, inner);
    } else if (list) {
      for (std::size_t i = 0; i < value.size(); ++i) result[i] = part(value[i], name);
    } else if (one) {
      result = part(value, name);
    }
    return result;
  }
  Json part(const Json& schema, const std::string& name) {
    if (!schema.is_object() || schema.empty()) return schema;
    return {{"$part", number_of(schema, name)}};
  }

  std::size_t numbered(Json shallow, const std::string& name) {
    const auto [found, is_new] = numbers_.emplace(shallow.dump(), parts_.size());
    if (is_new) {
      count_uses(shallow);
      parts_.push_back({std::move(shallow), name});
    }
    return found->second;
  }
  void count_uses(const Json& json) {
    if (json.is_object() && json.contains("$part")) ++parts_[json["$part"].get<std::size_t>()].uses;
    if (!json.is_structured()) return;
    for (const auto& inner : json) {
      if (inner.is_structured()) count_uses(inner);
    }
  }

  Json written(std::size_t number) {
    if (!parts_[number].reference.empty()) return {{"$ref", parts_[number].reference}};
    Json json = expanded(parts_[number].shallow);
    if (parts_[number].uses < 2 || json.dump().size() < kShortest || json.contains("$ref")) return json;
    std::string name = parts_[number].name;
    for (int i = 2; defs_.contains(name); ++i) name = parts_[number].name + "_" + std::to_string(i);
    parts_[number].reference = "#/$defs/" + name;
    defs_[name] = std::move(json);
    return {{"$ref", parts_[number].reference}};
  }
  Json expanded(const Json& shallow) {
    if (!shallow.is_structured()) return shallow;
    if (shallow.is_object() && shallow.contains("$part")) {
      Json json = written(shallow["$part"].get<std::size_t>());
      for (const auto& [key, value] : shallow.items()) {
        if (key != "$part") json[key] = value;
      }
      return json;
    }
    Json json = shallow;
    for (auto& [key, inner] : json.items()) inner = expanded(inner);
    return json;
  }

  std::map<std::string, std::size_t> numbers_;
  std::vector<Part> parts_;
  Json defs_ = Json::object();
};

/// JSON in lines of at most `kWidest` columns, where it can be.
void add_json(const Json& json, const std::string& lead, const std::string& margin, const char* end,
              std::string& text) {
  constexpr std::size_t kWidest = 150;
  const std::string line = json.dump();
  if (!json.is_structured() || json.empty() || margin.size() + lead.size() + line.size() <= kWidest) {
    text += margin + lead + line + end + "\n";
    return;
  }
  text += margin + lead + (json.is_object() ? "{" : "[") + "\n";
  std::size_t left = json.size();
  for (const auto& [key, value] : json.items()) {
    add_json(value, json.is_object() ? Json(key).dump() + ": " : "", margin + " ", --left > 0 ? "," : "", text);
  }
  text += margin + (json.is_object() ? "}" : "]") + end + "\n";
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

std::string key_text(const std::string& key) {
  const bool digits = !key.empty() && key.find_first_not_of("0123456789") == std::string::npos;
  return digits || reads_as_text(key) ? key : Json(key).dump();
}

/// A single value as a block may have it.
std::string plain_text(const ConfigNode& node) {
  const bool is_value = !node.quoted && (parse_number(node.scalar) || parse_integer(node.scalar) ||
                                         node.scalar == "true" || node.scalar == "false");
  return is_value || reads_as_text(node.scalar) ? node.scalar : Json(node.scalar).dump();
}

void add_block(const ConfigNode& node, const std::string& lead, const std::string& margin, std::vector<Line>& lines) {
  bool first = true;
  const auto add = [&](const std::string& key, const ConfigNode& value, bool is_item) {
    const std::string start = (std::exchange(first, false) ? lead : margin) + key;
    const bool filled = !value.items.empty() || !value.entries.empty();
    if (filled && is_item) add_block(value, start + " ", margin + "  ", lines);
    else if (filled) {
      lines.push_back({start, ""});
      add_block(value, margin + "  ", margin + "  ", lines);
    } else {
      lines.push_back({start + (value.is_map()    ? " {}"
                                : value.is_list() ? " []"
                                : value.is_null() ? ""
                                                  : " " + plain_text(value)),
                       ""});
    }
  };
  for (const auto& entry : node.entries) add(key_text(entry.key) + ":", entry.value, false);
  for (const ConfigNode& item : node.items) add("-", item, true);
}

/// A file of values: nothing that has none.
class ValueWriter {
 public:
  void write(const ParameterList& list, const std::string& lead, const std::string& margin) {
    bool first = true;
    for (const ParameterInfo* p : written(list)) {
      write(*p, std::exchange(first, false) ? lead : margin, margin);
    }
  }

  std::vector<Line> lines;

 private:
  /// What of a list has a value, with the keys of the form that is there.
  static std::vector<const ParameterInfo*> written(const ParameterList& list) {
    std::vector<const ParameterInfo*> all;
    for (const ParameterInfo& p : list) {
      if (p.kind == Kind::kForms) {
        for (const ParameterInfo* inner : written(p.members)) all.push_back(inner);
      } else if (p.kind == Kind::kSection && p.left_out) {
        if (!p.allowed.instead.empty()) all.push_back(&p);
      } else if (p.kind == Kind::kSection) {
        if (p.optional || !written(p.members).empty()) all.push_back(&p);
      } else if (!p.left_out) {
        all.push_back(&p);
      }
    }
    return all;
  }

  void write(const ParameterInfo& p, const std::string& lead, const std::string& margin) {
    const std::string inner = margin + "  ";
    const std::string about = p.about + (p.unit.empty() ? "" : " (" + p.unit + ")");
    const bool structure = p.kind == Kind::kSection || p.kind == Kind::kList || p.kind == Kind::kNamed;
    if (structure && p.left_out) return lines.push_back({lead + p.key + ": " + p.allowed.instead, about});
    if (p.kind == Kind::kOther && (!p.value.entries.empty() || !p.value.items.empty())) {
      lines.push_back({lead + p.key + ":", about});
      return add_block(p.value, inner, inner, lines);
    }
    if (!structure) return lines.push_back({lead + p.key + ": " + flow_text(p.value), about});
    if (p.kind == Kind::kSection) return write_map(p.members, lead + p.key + ":", about, inner);
    if (p.entries.empty()) {
      return lines.push_back({lead + p.key + (p.kind == Kind::kNamed ? ": {}" : ": []"), about});
    }
    lines.push_back({lead + p.key + ":", about});
    for (const auto& [name, entry] : p.entries) {
      if (p.kind == Kind::kNamed) {
        write_map(entry, inner + key_text(name) + ":", "", inner + "  ");
      } else if (written(entry).empty()) {
        lines.push_back({inner + "- {}", ""});
      } else {
        write(entry, inner + "- ", inner + "  ");
      }
    }
  }

  void write_map(const ParameterList& list, const std::string& key, const std::string& about,
                 const std::string& margin) {
    const bool empty = written(list).empty();
    lines.push_back({key + (empty ? " {}" : ""), about});
    write(list, margin, margin);
  }
};

std::string text_of(const std::vector<Line>& lines) {
  std::size_t column = 0;
  for (const Line& line : lines) {
    if (line.text.size() <= kFarthestComment) column = std::max(column, line.text.size());
  }
  std::string text;
  for (const Line& line : lines) {
    text += line.text;
    if (!line.about.empty()) {
      text += std::string(column > line.text.size() ? column - line.text.size() : 0, ' ') + "  # " + line.about;
    }
    text += '\n';
  }
  return text;
}

class YamlWriter {
 public:
  /// `given`: the list has values, not defaults. `lead` is the margin of the first line.
  void write(const ParameterList& list, bool given, const std::string& lead, const std::string& margin) {
    for (const ParameterInfo& p : list) write(p, given, &p == list.data() ? lead : margin, margin);
  }

  std::string text() const { return text_of(lines_); }

 private:
  using Kind = ParameterInfo::Kind;

  void write(const ParameterInfo& p, bool given, const std::string& lead, const std::string& margin) {
    if (p.kind == Kind::kForms) {
      write(p.members, given, lead, margin);
    } else if (p.kind == Kind::kSection || p.kind == Kind::kList || p.kind == Kind::kNamed) {
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

std::string parameter_schema(const std::string& title, const ParameterList& list) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  schema.update(object_of(list));
  return schema.dump(2) + "\n";
}

std::string schema_text(const std::string& schema) {
  std::string text;
  add_json(SharedSchemas().shared(Json::parse(schema)), "", "", "", text);
  return text;
}

std::string block_yaml(const ConfigNode& node, const std::string& margin) {
  std::vector<Line> lines;
  add_block(node, margin, margin, lines);
  return text_of(lines);
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

std::string written_yaml(const ParameterList& values, const std::string& margin) {
  ValueWriter writer;
  writer.write(values, margin, margin);
  return text_of(writer.lines);
}

std::string default_yaml(const std::string& title, const ParameterList& list) {
  YamlWriter writer;
  writer.write(list, false, "", "");
  return "# " + title + "\n" + writer.text();
}

}  // namespace ensonify
