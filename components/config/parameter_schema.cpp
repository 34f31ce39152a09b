#include <nlohmann/json.hpp>

#include "components/config/parameter_info.h"

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

}  // namespace

std::string object_schema(const ParameterList& list) { return object_of(list).dump(); }

std::string parameter_schema(const std::string& title, const ParameterList& list) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  schema.update(object_of(list));
  return schema.dump(2) + "\n";
}

}  // namespace ensonify
