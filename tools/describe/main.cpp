#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "components/config/config_error.h"
#include "components/config/config_node.h"
#include "components/config/config_text.h"
#include "components/config/data_paths.h"
#include "components/config/parse_yaml.h"
#include "components/errors/exit_code.h"
#include "components/errors/exit_error.h"
#include "components/errors/nearest_name.h"
#include "components/runtime/tool.h"
#include "launch/dataset/recipe.h"
#include "launch/file/launch_file.h"
#include "launch/process/run.h"
#include "messages/schema.h"
#include "scenarios/world/world.h"
#include "tools/describe/component_facts.h"

namespace {

using namespace ensonify;
using namespace ensonify::describe;
using Json = nlohmann::ordered_json;

std::string delay_text(SimTime delay) {
  return delay == SimTime{0} ? "" : fmt::format("{:g} ms", static_cast<double>(delay.count()) * 1e-6);
}

void print_ports(const ComponentFacts& facts) {
  if (facts.example.empty()) {
    fmt::print("\nPorts: {}\n", facts.no_ports_because);
    return;
  }
  fmt::print("\nPorts of {}:\n", facts.example);
  for (const OutPort& port : facts.outs) {
    fmt::print("  out {:<14} {:<18} at most {:g} Hz, {} bytes\n", port.port, port.type, port.rate.hz(), port.max_bytes);
  }
  for (const LivePort& port : facts.lives) {
    fmt::print("  out {:<14} {:<18} to viewers alone, {} bytes\n", port.port, port.type, port.max_bytes);
  }
  for (const InPort& port : facts.ins) {
    const std::string delay = delay_text(port.delay);
    fmt::print("  in  {:<14} {:<18} {}{}{}\n", port.port, port.type == "*" ? "any" : port.type,
               delay.empty() ? "" : "delay " + delay + (port.optional ? ", " : ""), port.optional ? "optional" : "",
               port.topics.empty() ? "" : fmt::format(": {}", fmt::join(port.topics, ", ")));
  }
  for (const auto& [type, content] : facts.declares) {
    fmt::print("  declares {}\n", type);
    for (const auto& [field, value] : *content.as<msg::Value::Map>()) {
      fmt::print("    {}: {}\n", field, msg::to_json(value));
    }
  }
}

Json ports_json(const ComponentFacts& facts) {
  Json json;
  for (const OutPort& port : facts.outs) {
    json["out"].push_back(
        {{"port", port.port}, {"type", port.type}, {"max_bytes", port.max_bytes}, {"rate_hz", port.rate.hz()}});
  }
  for (const LivePort& port : facts.lives) {
    json["live_only"].push_back({{"port", port.port}, {"type", port.type}, {"max_bytes", port.max_bytes}});
  }
  for (const InPort& port : facts.ins) {
    json["in"].push_back({{"port", port.port},
                          {"type", port.type},
                          {"delay_ns", port.delay.count()},
                          {"optional", port.optional},
                          {"topics", port.topics}});
  }
  for (const auto& [type, content] : facts.declares) json["declares"][type] = Json::parse(msg::to_json(content));
  return json;
}

void print_component(const std::string& name, bool as_yaml, bool as_json) {
  const ComponentFacts facts = facts_of(name);
  if (as_yaml) {
    fmt::print("{}", facts.default_yaml);
  } else if (as_json) {
    const ConfigDocument parameters = parse_config(facts.default_yaml, name + "/default.yaml");
    Json json = {{"component", name}, {"about", facts.about}, {"parameters", Json::parse(to_json(parameters.root))}};
    if (!facts.example.empty()) {
      json["ports_of"] = facts.example;
      json["ports"] = ports_json(facts);
    }
    fmt::print("{}\n", json.dump(2));
  } else {
    fmt::print("{}: {}\n", name, facts.about);
    print_ports(facts);
    fmt::print("\nParameters (under the process's `config:`):\n{}", facts.default_yaml);
  }
}

void print_fields(const std::vector<msg::FieldInfo>& fields, int indent) {
  std::size_t name_width = 0, type_width = 0, unit_width = 0;
  for (const msg::FieldInfo& f : fields) {
    name_width = std::max(name_width, f.name.size());
    type_width = std::max(type_width, msg::type_in_words(f).size());
    unit_width = std::max(unit_width, f.unit.size());
  }
  for (const msg::FieldInfo& f : fields) {
    fmt::print("{:{}}{:<{}}  {:<{}}  {:<{}}  {}\n", "", indent, f.name, name_width, msg::type_in_words(f), type_width,
               f.unit, unit_width, f.about);
    if (f.kind == msg::FieldInfo::Kind::list) print_fields(f.members.front().members, indent + 4);
  }
}

void print_message(const msg::TypeInfo& type, bool as_json) {
  if (as_json) {
    fmt::print("{}\n", Json::parse(msg::json_schema(&type)).dump(2));
    return;
  }
  fmt::print("{}: {}\n\n", type.type, type.about);
  print_fields(type.fields, 2);
}

void print_all(bool as_json) {
  if (as_json) {
    Json json = {{"components", component_names()}, {"messages", Json::array()}};
    for (const msg::TypeInfo& type : msg::message_types()) json["messages"].push_back(type.type);
    fmt::print("{}\n", json.dump(2));
    return;
  }
  fmt::print("Components (ensonify describe COMPONENT):\n  {}\n\nMessages (ensonify describe MESSAGE):\n",
             fmt::join(component_names(), ", "));
  for (const msg::TypeInfo& type : msg::message_types()) fmt::print("  {:<20} {}\n", type.type, type.about);
}

/// "ping/1", or "ping" for the highest major there is. A component of that name comes first.
const msg::TypeInfo* message_named(const std::string& name) {
  const msg::TypeInfo* found = msg::find_type(name);
  for (const msg::TypeInfo& type : msg::message_types()) {
    if (type.type.substr(0, type.type.find('/')) == name) found = &type;
  }
  return found;
}

/// Keys of a kind of file that users write, or of a part of it: "scenario.water", "mission.steps".
std::optional<ParameterList> list_of_file(const std::string& name) {
  if (name == "mission.steps") return step_list();
  if (name == "recipe") return parameters_of<dataset::Recipe>();
  const std::size_t end = std::min(name.find('.'), name.size());
  const std::string file = name.substr(0, end), part = name.substr(std::min(end + 1, name.size()));
  if (file != "scenario" && file != "mission") return std::nullopt;
  ParameterList list = file == "scenario" ? scenario_list() : mission_file_list();
  if (part.empty()) return list;
  const auto found = std::ranges::find(list, part, &ParameterInfo::key);
  if (found == list.end() || found->members.empty()) throw UserError(name + ": there is no such section");
  return found->members;
}

[[noreturn]] void refuse(const std::string& name) {
  std::vector<std::string> known = component_names();
  for (const msg::TypeInfo& type : msg::message_types()) known.push_back(type.type.substr(0, type.type.find('/')));
  const std::string near = nearest_name(name, known);
  throw UserError(name + ": is neither a component nor a message type" +
                  (near.empty() ? "; `ensonify describe` lists them" : "; did you mean " + near + "?"));
}

/// A scenario that stands over another need not repeat its sections, nor what these must have.
std::string scenario_schema() {
  Json schema = Json::parse(parameter_schema("Ensonify scenario", scenario_list()));
  schema["if"]["not"]["required"] = Json::array({"include"});
  schema["then"]["required"] = schema["required"];
  schema["required"] = Json::array({"ensonify"});
  for (auto& [key, section] : schema["properties"].items()) {
    for (const char* rule : {"required", "oneOf", "allOf"}) {
      if (!section.contains(rule)) continue;
      schema["then"]["properties"][key][rule] = section[rule];
      section.erase(rule);
    }
  }
  return schema.dump();
}

/// The parameters of a component or a file, as a schema for editors or a table for pages.
std::string parameters_of_name(const std::string& name, bool as_schema) {
  if (name == "scenario" && as_schema) return schema_text(scenario_schema());
  if (name == "launch" && as_schema) return launch_schema(component_schemas(), scenario_schema());
  if (const auto list = list_of_file(name)) {
    return as_schema ? schema_text(parameter_schema("Ensonify " + name, *list)) : parameter_table(*list);
  }
  const auto components = component_names();
  if (std::ranges::find(components, name) != components.end()) {
    return parameters_as(as_schema ? "schema" : "table", name);
  }
  const msg::TypeInfo* type = message_named(name);
  if (type && as_schema) return Json::parse(msg::json_schema(type)).dump(2) + "\n";
  if (!type) refuse(name);
  throw UserError(name + " is a message type; --table prints the parameters of a component, a scenario or a mission");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Says what there is: components with their parameters (defaults and units) and ports, messages with their "
      "fields.",
      "ensonify describe");
  std::string name;
  bool as_yaml = false, as_json = false, as_schema = false, as_table = false, reference = false;
  app.add_option("NAME", name,
                 "a component or a message type; without it, the list of both. With --schema or --table also launch, "
                 "recipe, scenario, mission, or a part of one: scenario.water");
  auto* yaml = app.add_flag("--yaml", as_yaml, "only the parameters with their defaults, as a configuration file");
  app.add_flag("--json", as_json, "as JSON; of a message type its JSON Schema")->excludes(yaml);
  auto* schema = app.add_flag("--schema", as_schema, "JSON Schema of the file or the parameters, for editors");
  app.add_flag("--table", as_table, "only the parameters, as a Markdown table")->excludes(yaml)->excludes(schema);
  app.add_flag("--reference", reference, "the page docs/manual/messages.md");
  if (const auto code = parse_command_line(app, argc, argv)) return *code;
  return exit_code_of([&] {
    const auto components = component_names();
    if (as_schema || as_table) {
      if (name.empty())
        throw UserError("--schema and --table need a NAME: launch, recipe, scenario, mission or a component");
      fmt::print("{}", parameters_of_name(name, as_schema));
    } else if (reference) {
      fmt::print("{}", msg::reference_page());
    } else if (name.empty()) {
      print_all(as_json);
    } else if (std::find(components.begin(), components.end(), name) != components.end()) {
      print_component(name, as_yaml, as_json);
      const msg::TypeInfo* namesake = message_named(name);
      if (namesake && !as_yaml && !as_json) fmt::print("\nThere is a message, too: {}\n", namesake->type);
    } else if (const msg::TypeInfo* type = message_named(name)) {
      if (as_yaml) throw UserError(name + " is a message type; --yaml prints the parameters of a component");
      print_message(*type, as_json);
    } else {
      refuse(name);
    }
    return static_cast<int>(kExitOk);
  });
}
