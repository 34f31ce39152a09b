#include "launch/file/launch_file.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "components/config/config_text.h"
#include "components/config/data_paths.h"
#include "components/config/parameter_info.h"
#include "components/config/parse_yaml.h"
#include "components/config/read_parameters.h"
#include "components/errors/nearest_name.h"
#include "components/runtime/address_list.h"
#include "launch/file/exits.h"
#include "launch/file/injections.h"
#include "launch/file/launch_keys.h"
#include "launch/file/tree.h"

namespace ensonify {
namespace {

namespace fs = std::filesystem;

/// Names that mean something else in `--set`, in topics or in the run directory.
bool is_reserved(const std::string& name) {
  return name == "clock" || name == "expect" || name == "launch" || is_scenario_section(name);
}

bool is_process_name(const std::string& name) {
  constexpr std::size_t kLongestName = 32;  // socket paths are short
  return !name.empty() && name.size() <= kLongestName && name[0] >= 'a' && name[0] <= 'z' &&
         name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
}

/// Who may reach the run's sockets.
void check_network(const ConfigReader& from, const ClockSettings& clock) {
  const bool tcp = clock.transport == ClockSettings::Transport::kTcp;
  for (const char* key : {"address", "port", "keys", "allow"}) {
    if (!tcp && from.has(key)) from.problem(key, "needs transport: tcp");
  }
  try {
    const AddressList addresses(clock.allow);
  } catch (const UserError& error) {
    from.problem("allow", error.what());
  }
  const bool is_loopback = clock.address.starts_with("127.");
  if (!is_address(clock.address) || clock.address == "0.0.0.0") {
    from.problem("address", "\"" + clock.address + "\" is no address; allowed: an IPv4 address of this machine");
  } else if (!is_loopback && !clock.keys) {
    from.problem("keys", "false is for the loopback interface; allowed: true with address " + clock.address);
  } else if (!is_loopback && clock.allow.empty()) {
    from.problem("address", "beyond the loopback interface asks for `allow`, the addresses that may take part");
  }
}

ConfigNode list_of_texts(const std::vector<std::string>& words) {
  ConfigNode list;
  list.kind = ConfigNode::Kind::kList;
  for (const std::string& word : words) list.items.push_back(detail::text_node(word));
  return list;
}

/// Inputs wired by hand, of processes that there are.
void read_wiring(const ConfigReader& from, const std::vector<ConnectionKeys>& keys, Launch& launch) {
  std::vector<std::string> names;
  for (const auto& process : launch.processes) names.push_back(process.name);
  for (const ConnectionKeys& key : keys) {
    if (key.topic.empty() && !from.good()) continue;  // an entry without a value: that is said already
    Connection connection;
    connection.place = key.place;
    const std::size_t dot = key.input.find('.');
    connection.process = key.input.substr(0, dot);
    connection.port = dot == std::string::npos ? "" : key.input.substr(dot + 1);
    const auto refuse = [&](const std::string& why) {
      from.add(ConfigError({{key.place, "wiring." + key.input, why}}));
    };
    if (connection.port.empty()) {
      refuse("is not PROCESS.PORT");
    } else if (std::find(names.begin(), names.end(), connection.process) == names.end()) {
      const std::string nearest = nearest_name(connection.process, names);
      refuse("no process is named " + connection.process + (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
    }
    connection.topic = key.topic;
    if (key.delay_s) connection.delay = from_seconds(*key.delay_s);
    launch.wiring.push_back(connection);
  }
}

void append_recorder(Launch& launch) {
  ProcessSpec recorder;
  recorder.name = "recorder";
  const auto taken = [&](const std::string& name) {
    return std::any_of(launch.processes.begin(), launch.processes.end(),
                       [&](const ProcessSpec& p) { return p.name == name; });
  };
  for (int n = 2; taken(recorder.name); ++n) {
    recorder.name = "recorder_" + std::to_string(n);
  }
  recorder.component = "recorder";
  recorder.place = {"--record"};
  recorder.config.root = ConfigNode::map(recorder.place);
  // As typed, from the working folder; a recorder's own relative paths start at the output folder.
  const std::string file = fs::absolute(launch.options.record).lexically_normal().string();
  recorder.config.root.set("file", ConfigNode::text(file, recorder.place));
  recorder.config.root.set("topics", ConfigNode::text("all", recorder.place));
  launch.processes.push_back(std::move(recorder));
}

/// What ends with an exit code is for the launcher; everything else goes to a process `expect`.
void read_expect(ConfigReader& from, const ConfigNode& list, Launch& launch) {
  if (list.is_null()) return;
  ConfigNode others = list;
  others.items = read_exits(from, launch);
  if (others.items.empty()) return;
  ProcessSpec expect;
  expect.name = "expect";
  expect.component = "expect";
  expect.place = list.place;
  expect.config.root = ConfigNode::map(list.place);
  expect.config.root.set("expect", std::move(others));
  launch.processes.push_back(std::move(expect));
}

/// Puts the output folder into `$(out)`. What else is wrong with a substitution was reported when the file was read.
void put_out_folder(Launch& launch) {
  std::vector<ConfigProblem> problems;
  const std::map<std::string, ConfigNode> values{{"out", ConfigNode::text(launch.options.out)}};
  const auto in_words = [&](std::vector<std::string>& words) {
    for (auto& word : words) {
      ConfigNode node = ConfigNode::text(word);
      substitute(node, values, {}, problems);
      word = node.scalar;
    }
  };
  for (auto& process : launch.processes) {
    substitute(process.config.root, values, {}, problems);
    in_words(process.argv);
    for (auto& [name, value] : process.env) {
      ConfigNode node = ConfigNode::text(value);
      substitute(node, values, {}, problems);
      value = node.scalar;
    }
  }
  for (auto& step : launch.after) {
    in_words(step.words);
  }
}

void read_scenario_file(ConfigReader& from, const ScenarioPlace& keys, const Overrides& overrides,
                        const ReadScenario& read_scenario, ScenarioFile& scenario) {
  const bool inside = keys.map.is_map();
  if (keys.path.empty() && !inside) {
    if (!overrides.empty() && !from.has("scenario")) {
      const auto& first = overrides.front();
      from.add(ConfigError({{first.second.place, "set." + first.first, "this launch has no scenario"}}));
    }
    return;
  }
  try {
    scenario.path = inside ? keys.map.place.file : keys.path;
    scenario.document = inside ? load_scenario({keys.map, {}}, overrides) : load_scenario(keys.path, overrides);
    scenario.text = to_canonical_yaml(scenario.document.root);
    ConfigReader header(scenario.document);  // its problems are reported by who reads the world
    read_header(header, scenario.header);
    if (read_scenario) {
      ConfigReader whole = from.also(scenario.document, inside ? "scenario" : "");
      read_scenario(whole, scenario.path);
    }
  } catch (const ConfigError& error) {
    from.add(error);
  }
}

}  // namespace

void Program::read(ConfigReader& from, const char* key) {
  const ConfigNode* run = from.node(key);
  if (run != nullptr && run->is_list()) {
    from.required(key, argv);
    if (argv.empty()) from.problem(key, "is an empty list; allowed: a component, or a program and its arguments");
  } else {
    from.optional(key, component);
  }
}

ConfigNode Program::in_file() const { return argv.empty() ? ConfigNode::text(component) : list_of_texts(argv); }

std::string Program::schema() {
  return R"({"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": ["string", "number", "boolean"]}}]})";
}

void ProcessConfig::read(ConfigReader& from, const char* key) {
  const ConfigNode* config = from.node(key);
  if (config == nullptr) return;
  if (config->is_map()) {
    root = *config;
    return;
  }
  from.required_path(key, file);
  if (file.empty()) return;
  try {
    static_cast<ConfigDocument&>(*this) = parse_config_file(file);
  } catch (const ConfigError& error) {
    file.clear();
    from.add(error);
  }
}

void EnvironmentVariables::read(ConfigReader& from, const char* key) {
  const ConfigNode* env = from.node(key);
  if (env == nullptr) return;
  bool good = env->is_map();
  for (const auto& entry : env->entries) {
    good &= entry.value.is_scalar() && entry.key.find('=') == std::string::npos;
    (*this)[entry.key] = entry.value.scalar;
  }
  if (!good) from.problem(key, "is not a map from names of environment variables to texts");
}

ConfigNode EnvironmentVariables::in_file() const {
  ConfigNode variables = ConfigNode::map();
  for (const auto& [name, value] : *this) variables.set(name, detail::text_node(value));
  return variables;
}

std::string EnvironmentVariables::schema() {
  return R"({"type": "object", "additionalProperties": {"type": ["string", "number", "boolean"]}})";
}

void ProcessSpec::check(const ConfigReader& from) const {
  if (!is_process_name(name)) {
    from.problem("", "is not a process name; allowed: up to 32 of a-z, 0-9 and _, beginning with a letter");
  } else if (is_reserved(name)) {
    from.problem("", "is a reserved name; choose another");
  }
  const ConfigNode* run = from.node("run");
  if (!external && run == nullptr) from.problem("run", "is missing; allowed: text");
  if (!external && run != nullptr && run->is_scalar() && !is_process_name(component)) {
    from.problem("run", "\"" + component + "\" is not a component; a foreign program is written as a list");
  }
  if (respawn && !observer) from.problem("respawn", "is only for observers; a lost participant ends the run");
  if (may_be_lost && observer) from.problem("may_be_lost", "is for participants; an observer may always be lost");
}

void ProcessSpec::complete(ConfigReader& from) {
  place = from.node().place;
  config_path = config.file.empty() ? "processes." + name + ".config" : "";
  if (!config.root.is_map()) config.root = ConfigNode::map(place);
}

void ClockSettings::check(const ConfigReader& from) const {
  if (from.good()) check_network(from, *this);
}

void ScenarioPlace::read(ConfigReader& from, const char* key) {
  const ConfigNode* node = from.node(key);
  if (node != nullptr && node->is_map()) map = *node;
  else from.optional_path(key, path);
}

std::string IncludeKey::schema() {
  const std::string one =
      R"({"type": "string"}, {"type": "object", "required": ["file"], "additionalProperties": false, "properties": {)"
      R"("file": {"type": "string", "description": "path of the launch file"}, "args": {"type": "object", )"
      R"("additionalProperties": {"type": ["string", "number", "boolean"]}, "description": "values of its arguments"}}})";
  return "{\"anyOf\": [" + one + R"(, {"type": "array", "items": {"anyOf": [)" + one + "]}}]}";
}

std::string ArgumentsKey::schema() {
  return R"({"type": "object", "additionalProperties": {"type": ["string", "number", "boolean", "null"]}})";
}

void ExpectKey::read(ConfigReader& from, const char* key) {
  const ConfigNode* node = from.node(key);
  if (node == nullptr || node->is_null()) return;
  if (node->is_list()) list = *node;
  else from.problem(key, "is not a list of expectations");
}

void AfterKey::read(ConfigReader& from, const char* key) {
  const ConfigNode* after = from.node(key);
  if (after == nullptr || after->is_null()) return;
  bool good = after->is_list();
  for (const auto& step : after->items) {
    AfterStep command{{}, step.place};
    good &= step.is_list() && !step.items.empty();
    for (const auto& word : step.items) {
      good &= word.is_scalar();
      command.words.push_back(word.scalar);
    }
    steps.push_back(std::move(command));
  }
  if (!good) from.problem(key, "is not a list of commands, each a list of words");
}

ConfigNode AfterKey::in_file() const {
  ConfigNode list;
  list.kind = ConfigNode::Kind::kList;
  for (const AfterStep& step : steps) list.items.push_back(list_of_texts(step.words));
  return list;
}

std::string AfterKey::schema() {
  return R"({"type": "array", "items": {"type": "array", "items": {"type": ["string", "number", "boolean"]}}})";
}

const ProcessSpec& Launch::process(const std::string& name) const {
  for (const auto& candidate : processes) {
    if (candidate.name == name) {
      return candidate;
    }
  }
  throw std::out_of_range("the launch has no process named \"" + name + "\"");
}

Isa isa_of(const Launch& launch) {
  const Isa widest = widest_isa(), wanted = launch.isa.value_or(widest);
  if (wanted > widest) {
    throw ConfigError(
        {{{launch.file},
          "isa",
          std::string("this machine has no ") + name_of(wanted) + "; allowed: best, " + name_of(widest)}});
  }
  return wanted;
}

Launch read_launch(const LaunchOptions& options, const ReadScenario& read_scenario) {
  Launch launch;
  launch.options = options;
  launch.file = find_data(options.file, {""});
  if (launch.file.empty()) {
    throw ConfigError({{{options.file}, "", "no such file"}});
  }
  ConfigDocument document = load_launch_tree(launch.file, options.args);
  const OverrideTargets targets =
      sort_overrides(overrides_of(document.root, options.sets, document.problems), document.root, document.problems);
  ConfigNode clock = document.root.find("clock") != nullptr ? *document.root.find("clock") : ConfigNode::map();
  const auto clock_problems = apply(targets.clock, clock);
  document.problems.insert(document.problems.end(), clock_problems.begin(), clock_problems.end());
  if (!clock.entries.empty()) {
    document.root.set("clock", std::move(clock));
  }

  const auto launch_problems = apply(targets.launch, document.root);
  document.problems.insert(document.problems.end(), launch_problems.begin(), launch_problems.end());

  ConfigReader from(std::move(document));
  LaunchKeys keys;
  read_parameters(from, keys);
  read_scenario_file(from, keys.scenario, targets.scenario, read_scenario, launch.scenario);
  launch.processes = std::move(keys.processes);
  for (ProcessSpec& process : launch.processes) {
    const auto found = targets.processes.find(process.name);
    if (found == targets.processes.end()) continue;
    if (const auto problems = apply(found->second, process.config.root); !problems.empty()) {
      from.add(ConfigError(problems));
    }
  }
  if (launch.processes.empty() && !(from.has("processes") && !from.good())) {
    from.problem("processes", "names no process; a launch needs at least one");
  }
  read_wiring(from, keys.wiring, launch);
  launch.clock = keys.clock;
  launch.isa = keys.isa;
  launch.after = keys.after.steps;
  if (keys.duration_s) {
    launch.duration = from_seconds(*keys.duration_s);
    launch.scenario.end_ns = launch.duration->count();
  }
  if (!options.record.empty()) {
    append_recorder(launch);
  }
  launch.injections = read_injections(from, keys.inject, launch.processes);
  read_expect(from, keys.expect.list, launch);
  launch.launch_text = canonical_text(launch);
  put_out_folder(launch);
  from.finish();
  return launch;
}

}  // namespace ensonify
