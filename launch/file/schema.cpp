
#include <nlohmann/json.hpp>
#include <utility>

#include "components/config/parameter_info.h"
#include "launch/file/launch_file.h"

namespace ensonify {
namespace {

using Json = nlohmann::ordered_json;

const Json kText = {{"type", "string"}};
const Json kScalar = {{"type", {"string", "number", "boolean"}}};
const Json kAnything = Json::object();

Json list_of(const Json& items) { return {{"type", "array"}, {"items", items}}; }
Json map_of(const Json& values) { return {{"type", "object"}, {"additionalProperties", values}}; }
Json said(Json schema, const char* sentence) {
  schema["description"] = sentence;
  return schema;
}
Json either(std::initializer_list<Json> forms) { return {{"anyOf", Json(forms)}}; }

ParameterInfo key(const std::string& name, const std::string& about, const Json& schema, bool required = false) {
  return other_info(name, about, schema.dump(), required);
}

/// The same schema for values that may also be an argument of the launch file.
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
  const bool structure = changed.contains("properties") || changed.contains("additionalProperties");
  const bool plain = changed.contains("enum") || changed.contains("const") || (changed.contains("type") && !structure);
  if (!plain || changed.value("type", Json()) == "string") return changed;
  Json value = Json::object(), outer = Json::object();
  for (auto& [name, of] : changed.items()) (name == "description" || name == "default" ? outer : value)[name] = of;
  outer["anyOf"] = {std::move(value), {{"type", "string"}, {"pattern", "\\$\\("}}};
  return outer;
}

ParameterList process_list() {
  ParameterList list = parameters_of<ProcessSpec>();
  list.insert(list.begin(),
              key("run", "a component, or a program and its arguments as a list", either({kText, list_of(kScalar)})));
  list.push_back(
      key("config", "its own parameters, or the path of a file with them", either({kText, map_of(kAnything)})));
  list.push_back(key("env", "environment variables", map_of(kScalar)));
  list.push_back(key("cpus", "processors that it may run on", list_of({{"type", "number"}, {"minimum", 0}})));
  return list;
}

ParameterList clock_list() {
  ParameterList list = parameters_of<ClockSettings>();
  const Json number = {{"type", "number"}, {"minimum", 1e-3}, {"maximum", 1e6}};
  list.insert(list.begin(), key("rate", "sim seconds per wall second, or free: as fast as it goes",
                                either({{{"const", "free"}}, number})));
  return list;
}

ParameterList launch_list() {
  const Json connection = {
      {"type", "object"},
      {"required", {"topic"}},
      {"additionalProperties", false},
      {"properties",
       {{"topic", said(kText, "PROCESS/PORT of the output")},
        {"delay_ms", said({{"type", "number"}, {"minimum", 0}}, "ms; it may only lengthen the port's own")}}}};
  const Json include = {
      {"type", "object"},
      {"required", {"file"}},
      {"additionalProperties", false},
      {"properties",
       {{"file", said(kText, "path of the launch file")}, {"args", said(map_of(kScalar), "values of its arguments")}}}};
  Json expectation = {{"type", "object"},
                      {"additionalProperties", false},
                      {"properties", {{"name", said(kText, "what the verdict calls it; unique")}}}};
  const std::pair<const char*, const char*> kinds[] = {{"count", "how many messages a topic has at least or at most"},
                                                       {"rate", "messages a second of sim time"},
                                                       {"bounds", "limits of a field, in every message"},
                                                       {"eventually", "a message that comes within some time"},
                                                       {"never", "a message that does not come"},
                                                       {"order", "a message that comes after another"},
                                                       {"no_gap", "sequence numbers without a gap"},
                                                       {"same_as", "a record whose messages the run repeats"},
                                                       {"exit", "how a process ends: exit code or signal"}};
  for (const auto& [kind, sentence] : kinds) expectation["properties"][kind] = said(map_of(kAnything), sentence);
  const Json argument = {{"type", {"string", "number", "boolean", "null"}}};
  return {key("ensonify", "the format", {{"const", kLaunchFormat}}, true),
          key("args", "arguments with their defaults; null: must be given", map_of(argument)),
          key("include", "launch files that this one goes on from",
              either({kText, include, list_of(either({kText, include}))})),
          key("scenario", "path of the scenario", kText),
          key("set", "changes of parameters: PROCESS.KEY or SECTION.KEY to a value", map_of(kAnything)),
          named_info("processes", "which processes run together, by names of your own", process_list()),
          key("wiring", "PROCESS.PORT of an input to the topic that it takes", map_of(either({kText, connection}))),
          section_info("clock", "pacing and supervision", clock_list()),
          key("duration_s", "the run's end, sim time", {{"type", "number"}, {"minimum", 1e-3}, {"maximum", 1e7}}),
          key("expect", "what must hold for the run to succeed", list_of(expectation)),
          key("after", "commands to run when all went well", list_of(list_of(kScalar)))};
}

}  // namespace

std::string launch_schema(const std::map<std::string, std::string>& components) {
  Json schema = Json::parse(parameter_schema("Ensonify launch file", launch_list()));
  Json forms = Json::array(), lists = Json::object();
  for (const auto& [name, text] : components) {
    Json list = Json::parse(text);
    if (list["properties"].empty()) continue;  // it has none of its own to check
    list.erase("$schema");
    list.erase("title");
    lists[name] = std::move(list);
    const Json parameters = either({kText, {{"$ref", "#/$defs/" + name}}});
    forms.push_back({{"if", {{"properties", {{"run", {{"const", name}}}}}, {"required", {"run"}}}},
                     {"then", {{"properties", {{"config", parameters}}}}}});
  }
  schema["$defs"] = std::move(lists);
  Json changed = with_arguments(schema);
  if (!forms.empty()) changed["properties"]["processes"]["additionalProperties"]["allOf"] = std::move(forms);
  return changed.dump(2) + "\n";
}

}  // namespace ensonify
