#include "launch/file/launch_file.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "components/config/data_paths.h"
#include "components/config/read_parameters.h"
#include "components/errors/nearest_name.h"
#include "components/runtime/address_list.h"
#include "launch/file/exits.h"
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

ClockSettings read_clock(ConfigReader from) {
  ClockSettings clock;
  if (const ConfigNode* rate = from.node("rate"); rate != nullptr && !(rate->is_scalar() && rate->scalar == "free")) {
    double value = 1.0;
    from.required("rate", value, 1e-3, 1e6);
    clock.rate = value;
  }
  read_parameters(from, clock);
  if (from.good()) check_network(from, clock);
  return clock;
}

/// `run: multibeam` or `run: [python3, agent.py]`.
void read_run(ConfigReader& from, ProcessSpec& process) {
  const ConfigNode* run = from.node("run");
  if (run != nullptr && run->is_list()) {
    from.required("run", process.argv);
    if (process.argv.empty()) {
      from.problem("run", "is an empty list; allowed: a component, or a program and its arguments");
    }
    return;
  }
  if (process.external) {
    from.optional("run", process.component);
    return;
  }
  from.required("run", process.component);
  if (run != nullptr && run->is_scalar() && !is_process_name(process.component)) {
    from.problem("run", "\"" + process.component + "\" is not a component; a foreign program is written as a list");
  }
}

void read_config(ConfigReader& from, ProcessSpec& process) {
  const ConfigNode* config = from.node("config");
  process.config.root = ConfigNode::map(process.place);
  process.config_path = "processes." + process.name + ".config";
  if (config == nullptr) {
    return;
  }
  if (config->is_map()) {
    process.config.root = *config;
    return;
  }
  std::string path;
  from.required_path("config", path);
  if (!path.empty()) {
    try {
      process.config = parse_config_file(path);
      process.config_path = "";
    } catch (const ConfigError& error) {
      from.add(error);
    }
  }
}

void read_env(ConfigReader& from, ProcessSpec& process) {
  const ConfigNode* env = from.node("env");
  if (env == nullptr) {
    return;
  }
  bool good = env->is_map();
  for (const auto& entry : env->entries) {
    good &= entry.value.is_scalar() && entry.key.find('=') == std::string::npos;
    process.env[entry.key] = entry.value.scalar;
  }
  if (!good) {
    from.problem("env", "is not a map from names of environment variables to texts");
  }
}

ProcessSpec read_process(const std::string& name, ConfigReader& from) {
  ProcessSpec process;
  process.name = name;
  process.place = from.node().place;
  if (!is_process_name(name)) {
    from.problem("", "is not a process name; allowed: up to 32 of a-z, 0-9 and _, beginning with a letter");
  } else if (is_reserved(name)) {
    from.problem("", "is a reserved name; choose another");
  }
  read_parameters(from, process);
  read_run(from, process);
  read_config(from, process);
  read_env(from, process);
  std::vector<double> cpus;
  from.optional("cpus", cpus, 0, 4095);
  for (const double cpu : cpus) {
    process.cpus.push_back(static_cast<int>(cpu));
  }
  if (process.respawn && !process.observer) {
    from.problem("respawn", "is only for observers; a lost participant ends the run");
  }
  return process;
}

void read_wiring(ConfigReader& from, Launch& launch) {
  const ConfigNode* wiring = from.node("wiring");
  if (wiring == nullptr || wiring->is_null()) {
    return;
  }
  if (!wiring->is_map()) {
    from.problem("wiring", "is not a map from process.port to a topic");
    return;
  }
  std::vector<std::string> names;
  for (const auto& process : launch.processes) {
    names.push_back(process.name);
  }
  // A topic alone is short for {topic: ...}; everything else is read as a section.
  ConfigNode sections = *wiring;
  for (auto& entry : sections.entries) {
    if (entry.value.is_scalar()) {
      ConfigNode section = ConfigNode::map(entry.value.place);
      section.set("topic", entry.value);
      entry.value = std::move(section);
    }
  }
  ConfigNode holder = ConfigNode::map(wiring->place);
  holder.set("wiring", std::move(sections));
  for (auto& [key, reader] : from.also({std::move(holder), {}}).named_sections("wiring")) {
    Connection connection;
    connection.place = reader.node().place;
    const std::size_t dot = key.find('.');
    connection.process = key.substr(0, dot);
    connection.port = dot == std::string::npos ? "" : key.substr(dot + 1);
    if (connection.port.empty()) {
      reader.problem("", "is not PROCESS.PORT");
    } else if (std::find(names.begin(), names.end(), connection.process) == names.end()) {
      const std::string nearest = nearest_name(connection.process, names);
      reader.problem(
          "", "no process is named " + connection.process + (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
    }
    reader.required("topic", connection.topic);
    if (reader.has("delay_ms")) {
      double delay_s = 0.0;
      reader.required("delay_ms", delay_s, 0, 1e7, kMilliseconds);
      connection.delay = from_seconds(delay_s);
    }
    launch.wiring.push_back(connection);
  }
}

void read_after(ConfigReader& from, Launch& launch) {
  const ConfigNode* after = from.node("after");
  if (after == nullptr || after->is_null()) {
    return;
  }
  bool good = after->is_list();
  for (const auto& step : after->items) {
    AfterStep command{{}, step.place};
    good &= step.is_list() && !step.items.empty();
    for (const auto& word : step.items) {
      good &= word.is_scalar();
      command.words.push_back(word.scalar);
    }
    launch.after.push_back(std::move(command));
  }
  if (!good) {
    from.problem("after", "is not a list of commands, each a list of words");
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
void read_expect(ConfigReader& from, Launch& launch) {
  const ConfigNode* list = from.node("expect");
  if (list == nullptr || list->is_null()) {
    return;
  }
  if (!list->is_list()) {
    from.problem("expect", "is not a list of expectations");
    return;
  }
  ConfigNode others = *list;
  others.items = read_exits(from, launch);
  if (others.items.empty()) {
    return;
  }
  ProcessSpec expect;
  expect.name = "expect";
  expect.component = "expect";
  expect.place = list->place;
  expect.config.root = ConfigNode::map(list->place);
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

void read_scenario_file(ConfigReader& from, const Overrides& overrides, const ReadScenario& read_scenario,
                        ScenarioFile& scenario) {
  std::string path;
  from.optional_path("scenario", path);
  if (path.empty()) {
    if (!overrides.empty() && !from.has("scenario")) {
      const auto& first = overrides.front();
      from.add(ConfigError({{first.second.place, "set." + first.first, "this launch has no scenario"}}));
    }
    return;
  }
  try {
    scenario.document = load_scenario(path, overrides);
    scenario.path = path;
    scenario.text = to_canonical_yaml(scenario.document.root);
    ConfigReader header(scenario.document);  // its problems are reported by who reads the world
    read_header(header, scenario.header);
    if (read_scenario) {
      ConfigReader whole = from.also(scenario.document);
      read_scenario(whole, path);
    }
  } catch (const ConfigError& error) {
    from.add(error);
  }
}

}  // namespace

const ProcessSpec& Launch::process(const std::string& name) const {
  for (const auto& candidate : processes) {
    if (candidate.name == name) {
      return candidate;
    }
  }
  throw std::out_of_range("the launch has no process named \"" + name + "\"");
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

  ConfigReader from(std::move(document));
  read_format(from, kLaunchFormat);
  from.node("set");
  read_scenario_file(from, targets.scenario, read_scenario, launch.scenario);
  for (auto& [name, reader] : from.named_sections("processes")) {
    ProcessSpec process = read_process(name, reader);
    if (const auto found = targets.processes.find(name); found != targets.processes.end()) {
      if (const auto problems = apply(found->second, process.config.root); !problems.empty()) {
        from.add(ConfigError(problems));
      }
    }
    launch.processes.push_back(std::move(process));
  }
  if (launch.processes.empty() && !(from.has("processes") && !from.good())) {
    from.problem("processes", "names no process; a launch needs at least one");
  }
  read_wiring(from, launch);
  if (const auto section = from.optional_section("clock")) {
    launch.clock = read_clock(*section);
  }
  read_after(from, launch);
  if (from.has("duration_s")) {
    double duration_s = 0.0;
    from.required("duration_s", duration_s, 1e-3, 1e7);
    launch.duration = from_seconds(duration_s);
    launch.scenario.end_ns = launch.duration->count();
  }
  if (!options.record.empty()) {
    append_recorder(launch);
  }
  read_expect(from, launch);
  launch.launch_text = canonical_text(launch);
  put_out_folder(launch);
  from.finish();
  return launch;
}

}  // namespace ensonify
