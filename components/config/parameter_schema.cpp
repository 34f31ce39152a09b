#include "components/config/parameter_schema.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "components/config/config_text.h"

namespace ensonify {

namespace {

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
  const auto inner =
      std::find_if(p.members.begin(), p.members.end(), [&](const auto& m) { return m.key == p.short_key; });
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

/// Keys of a list and of its forms.
std::vector<std::string> all_keys(const ParameterList& list) {
  std::vector<std::string> keys;
  for (const ParameterInfo& p : list) {
    if (p.kind != Kind::kForms) keys.push_back(p.key);
    for (const ParameterList& form : p.forms) {
      for (std::string& key : all_keys(form)) keys.push_back(std::move(key));
    }
  }
  return keys;
}

Json one_of(const ParameterInfo& p, const ParameterList& list);

/// What holds for form `i` of those that stand among the keys of `list`: keys that it must have, and none of another's.
Json rules_of(const ParameterInfo& p, std::size_t i, const ParameterList& list) {
  const ParameterList& own = p.forms[i];
  const bool by_word = !p.by.empty(), keyless = by_word || (p.last_has_no_key && i + 1 == p.forms.size());
  Json rules = Json::object(), required = Json::array();
  if (by_word) {
    const auto word = std::find_if(list.begin(), list.end(), [&](const auto& key) { return key.key == p.by; });
    const std::string& text = word->allowed.words[i].text;
    rules["properties"][p.by] = {{"const", text}};
    if (word->allowed.required || text != word->value.scalar) required.push_back(p.by);
  }
  if (!keyless) required.push_back(own.front().key);
  for (const ParameterInfo& key : own) {
    if (key.allowed.required && (keyless || &key != own.data())) required.push_back(key.key);
    if (key.kind == Kind::kForms) rules["oneOf"] = one_of(key, own);
  }
  if (!required.empty()) rules["required"] = std::move(required);
  for (const ParameterList& other : p.forms) {
    for (const std::string& key : all_keys(other)) {
      // Two forms' first keys fit no one form.
      if (!lists_key(own, key) && (keyless || key != other.front().key)) rules["properties"][key] = false;
    }
  }
  return rules;
}

Json one_of(const ParameterInfo& p, const ParameterList& list) {
  Json forms = Json::array();
  for (std::size_t i = 0; i < p.forms.size(); ++i) forms.push_back(rules_of(p, i, list));
  return forms;
}

Json object_of(const ParameterList& list) {
  if (list.size() == 1 && list.front().kind == Kind::kForms) {
    const ParameterInfo& p = list.front();
    Json forms = Json::array();
    for (const ParameterList& form : p.forms) {
      Json json = object_of(form);
      const bool keyless = p.last_has_no_key && &form == &p.forms.back();
      if (!keyless && !form.front().allowed.required) json["required"].push_back(form.front().key);
      forms.push_back(std::move(json));
    }
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
      numbers.push_back(part(of, name)["$part"].get<std::size_t>());
      Part& own_part = parts_[numbers.back()];
      if (own_part.reference.empty()) own_part.reference = "#/$defs/" + name;
      defs_[name] = {{"$ref", own_part.reference}};  // until it is written
    }
    Json result = expanded(parts_[part(schema, "schema")["$part"].get<std::size_t>()].shallow);
    std::size_t next = 0;
    for (const auto& [name, of] : own.items()) {
      const Part& own_part = parts_[numbers[next++]];
      if (own_part.reference == "#/$defs/" + name) defs_[name] = expanded(own_part.shallow);
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

  /// A part, to stand in another: its number, which equal parts share, with what is said of it there. `name` is that of
  /// the first place where it stands.
  Json part(const Json& schema, const std::string& name) {
    if (!schema.is_object() || schema.empty()) return schema;
    Json core = Json::object(), said = Json::object();
    for (const auto& [key, value] : schema.items()) {
      const bool says = (key == "description" || key == "default") && schema.size() > 1;
      (says ? said : core)[key] = says ? value : with_parts(key, value, name);
    }
    said["$part"] = numbered(std::move(core), name);
    return said;
  }

  Json with_parts(const std::string& key, const Json& value, const std::string& name) {
    const bool map = key == "properties" || key == "$defs";
    const bool list = key == "anyOf" || key == "allOf";  // oneOf has rules for keys, no values
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

/// Whole numbers without a decimal point.
void shorten_numbers(Json& json) {
  if (json.is_number_float() && std::abs(json.get<double>()) < 1e15 &&
      json.get<double>() == std::trunc(json.get<double>())) {
    json = json.get<std::int64_t>();
  }
  if (!json.is_structured()) return;
  for (Json& inner : json) shorten_numbers(inner);
}

/// JSON in lines of at most `kWidest` columns, where it can be.
void add_json(const Json& json, const std::string& lead, const std::string& margin, const char* end,
              std::string& text) {
  constexpr std::size_t kWidest = 200;
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

}  // namespace

std::string object_schema(const ParameterList& list) { return object_of(list).dump(); }

std::string parameter_schema(const std::string& title, const ParameterList& list) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  schema.update(object_of(list));
  return schema.dump(2) + "\n";
}

std::string schema_text(const std::string& schema) {
  Json json = Json::parse(schema);
  shorten_numbers(json);
  std::string text;
  add_json(SharedSchemas().shared(std::move(json)), "", "", "", text);
  return text;
}

}  // namespace ensonify
