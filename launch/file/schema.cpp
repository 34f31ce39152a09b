#include <nlohmann/json.hpp>
#include <utility>

#include "components/config/parameter_info.h"
#include "launch/file/launch_keys.h"

namespace ensonify {
namespace {

using Json = nlohmann::ordered_json;

/// The same schema for values that may also be an argument of the launch file: a text that holds $(.
Json with_arguments(const Json& schema) {
  if (!schema.is_object()) return schema;
  Json changed = Json::object();
  for (const auto& [name, value] : schema.items()) {
    if (name == "properties" || name == "$defs") {
      for (const auto& [inner, of] : value.items()) changed[name][inner] = with_arguments(of);
    } else if (name == "anyOf") {
      for (const Json& form : value) changed[name].push_back(with_arguments(form));
    } else if (name == "items" || name == "additionalProperties") {
      changed[name] = with_arguments(value);
    } else {
      changed[name] = value;
    }
  }
  if (changed.contains("properties") || changed.contains("additionalProperties")) return changed;
  if (changed.contains("enum") || changed.contains("const")) {
    Json words = Json::object();
    for (const char* key : {"enum", "const"}) {
      if (changed.contains(key)) words[key] = changed[key], changed.erase(key);
    }
    changed["anyOf"] = {std::move(words), {{"type", "string"}, {"pattern", "\\$\\("}}};
  } else if (changed.contains("type") && changed["type"].is_string() && changed["type"] != "string") {
    changed["type"] = {changed["type"], "string"};
    changed["pattern"] = "\\$\\(";
  }
  return changed;
}

/// The list that the component `expect` has, and how a process ends, which the launcher judges.
Json expectations(const Json& component) {
  Json list = component["properties"]["expect"];
  list["items"]["properties"]["exit"] = {{"type", "object"}, {"description", "end of a process: exit code or signal"}};
  return list;
}

}  // namespace

std::string launch_schema(const std::map<std::string, std::string>& components, const std::string& scenario) {
  Json schema = Json::parse(parameter_schema("Ensonify launch file", parameters_of<LaunchKeys>()));
  Json forms = Json::array(), lists = Json::object();
  for (const auto& [name, text] : components) {
    Json list = Json::parse(text);
    if (list["properties"].empty()) continue;  // it has none of its own to check
    list.erase("$schema");
    list.erase("title");
    if (name == "expect") schema["properties"]["expect"].update(expectations(list));
    lists[name] = std::move(list);
    const Json parameters = {{"anyOf", {{{"type", "string"}}, {{"$ref", "#/$defs/" + name}}}}};
    forms.push_back({{"if", {{"properties", {{"run", {{"const", name}}}}}, {"required", {"run"}}}},
                     {"then", {{"properties", {{"config", parameters}}}}}});
  }
  lists["scenario"] = Json::parse(scenario);
  lists["scenario"].erase("$schema");
  lists["scenario"].erase("title");
  Json& place = schema["properties"]["scenario"];
  place.erase("type");
  place["anyOf"] = {{{"type", "string"}}, {{"$ref", "#/$defs/scenario"}}};
  schema["$defs"] = std::move(lists);
  Json changed = with_arguments(schema);
  if (!forms.empty()) changed["properties"]["processes"]["additionalProperties"]["allOf"] = std::move(forms);
  return schema_text(changed.dump());
}

}  // namespace ensonify
