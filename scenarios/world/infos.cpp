#include <nlohmann/json.hpp>
#include <utility>

#include "scenarios/world/sections.h"

namespace ensonify {
namespace {

using Json = nlohmann::ordered_json;
using Kind = ParameterInfo::Kind;

ParameterInfo plain(Kind kind, const std::string& key, const std::string& about, Allowed allowed, bool required) {
  ParameterInfo info{.key = key, .allowed = std::move(allowed), .about = about, .kind = kind, .left_out = true};
  info.allowed.required = required;
  return info;
}

Json map_of(const ParameterList& list) { return Json::parse(object_schema(list)); }

Json enum_of(const Allowed& allowed) {
  Json words = Json::array();
  for (const Word& word : allowed.words) words.push_back(word.text);
  return {{"enum", words}};
}

}  // namespace

ParameterInfo format_info(const std::string& format) {
  return other_info("ensonify", "the format", Json{{"const", format}}.dump(), true);
}

ParameterInfo text_info(const std::string& key, const std::string& about, bool required) {
  return plain(Kind::kText, key, about, any(), required);
}

ParameterInfo file_info(const std::string& key, const std::string& about, bool required) {
  return plain(Kind::kText, key, about, path(), required);
}

ParameterInfo word_info(const std::string& key, const std::string& about, Allowed words) {
  return plain(Kind::kWord, key, about, std::move(words), false);
}

ParameterInfo classes_info(const std::string& key, const std::string& about) {
  return plain(Kind::kNumbers, key, about, in(0, 255), false);
}

ParameterInfo file_or_info(const std::string& key, const std::string& about, const ParameterList& map) {
  const Json file = {{"type", "string"}, {"minLength", 1}};
  return other_info(key, about, Json{{"anyOf", {file, map_of(map)}}}.dump());
}

ParameterInfo word_or_info(const std::string& key, const std::string& about, const std::string& word,
                           const ParameterList& map) {
  return other_info(key, about, Json{{"anyOf", {Json{{"const", word}}, map_of(map)}}}.dump());
}

ParameterInfo words_or_maps_info(const std::string& key, const std::string& about, const std::string& names,
                                 const Allowed& words, const ParameterList& map) {
  const Json json = {{"type", "object"},
                     {"propertyNames", {{"pattern", names}}},
                     {"additionalProperties", {{"anyOf", {enum_of(words), map_of(map)}}}}};
  return other_info(key, about, json.dump());
}

ParameterInfo forms_info(const std::string& key, const std::string& about, const ParameterList& forms) {
  Json either = Json::array();
  for (const ParameterInfo& form : forms) either.push_back(map_of(form.members));
  return other_info(key, about, Json{{"type", "array"}, {"items", {{"anyOf", either}}}}.dump());
}

}  // namespace ensonify
