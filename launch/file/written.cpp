#include <algorithm>
#include <sstream>

#include "components/config/data_paths.h"
#include "components/config/parameter_info.h"
#include "components/config/parse_yaml.h"
#include "launch/file/injections.h"
#include "launch/file/launch_keys.h"

namespace ensonify {
namespace {

const std::string kMargin = "  ";

std::string indented(const std::string& text, const std::string& margin) {
  std::string result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) result += margin + line + "\n";
  return result;
}

/// As it was read, its configuration apart.
std::string stanza_of(const ProcessSpec& process) {
  ConfigNode given = ConfigNode::map();
  if (!process.component.empty() || !process.argv.empty()) given.set("run", {});
  if (!process.cpus.empty()) given.set("cpus", {});
  if (!process.env.empty()) given.set("env", {});
  return written_yaml(parameters_of(process, &given), kMargin + kMargin);
}

/// A program of the user's own stays where it is found: beside the launch file, unless it is the project's.
ProcessSpec with_own_paths(ProcessSpec process, const std::string& launch_file) {
  const std::string folder = launch_file.substr(0, launch_file.find_last_of('/') + 1);
  for (std::string& word : process.argv) {
    if (word.find('/') == std::string::npos || !find_data(word, {}).empty()) continue;
    if (const std::string found = find_data(word, {".", folder}); !found.empty()) word = detail::absolute_path(found);
  }
  return process;
}

/// The place of what stands in a launch under "scenario.site.name" or "processes.bow.config.file"; that of its file
/// where it came from elsewhere, such as a mission of its own.
ConfigPlace place_in(const Launch& launch, const std::string& path) {
  const auto found = [&](const std::string& top, const ConfigNode& root) -> std::optional<ConfigPlace> {
    if (!path.starts_with(top + ".")) return std::nullopt;
    const ConfigPlace place = ConfigReader({root, {}}).problem_at(path.substr(top.size() + 1), "").place;
    return place.file.empty() ? std::nullopt : std::optional(place);
  };
  if (const auto place = found("scenario", launch.scenario.document.root)) return *place;
  for (const ProcessSpec& process : launch.processes) {
    const std::string top = "processes." + process.name;
    if (const auto place = found(top + ".config", process.config.root)) return *place;
    if (path.starts_with(top + ".")) return process.place;
  }
  return {launch.file, 0, 0};
}

/// A launch file puts arguments in for $(: there is no way to write it.
void find_unwritable(const Launch& launch, const ConfigNode& node, const std::string& path,
                     std::vector<ConfigProblem>& problems) {
  for (std::size_t at = 0; (at = node.scalar.find("$(", at)) != std::string::npos; at += 2) {
    if (node.scalar.compare(at, 6, "$(out)") == 0) continue;
    problems.push_back({place_in(launch, path), path,
                        "\"" + node.scalar + "\" cannot be printed: in a launch file $( stands for an argument"});
    break;
  }
  for (const auto& entry : node.entries)
    find_unwritable(launch, entry.value, path + (path.empty() ? "" : ".") + entry.key, problems);
  for (std::size_t i = 0; i < node.items.size(); ++i)
    find_unwritable(launch, node.items[i], path + "[" + std::to_string(i) + "]", problems);
}

}  // namespace

std::string written_launch(const Launch& launch, const std::string& scenario, const WrittenConfig& config_of) {
  LaunchKeys keys;
  keys.clock = launch.clock;
  keys.isa = launch.isa;
  keys.after.steps = launch.after;
  keys.inject = keys_of(launch.injections);
  if (launch.duration) keys.duration_s = seconds(*launch.duration);
  for (const Connection& connection : launch.wiring) {
    ConnectionKeys& key = keys.wiring.emplace_back();
    key.input = connection.process + "." + connection.port;
    key.topic = connection.topic;
    if (connection.delay) key.delay_s = seconds(*connection.delay);
  }
  ConfigNode given = ConfigNode::map();
  if (!launch.after.empty()) given.set("after", {});
  if (launch.clock.transport == ClockSettings::Transport::kTcp) {
    ConfigNode clock = ConfigNode::map();
    for (const char* key : {"address", "port", "keys", "allow"}) clock.set(key, {});
    given.set("clock", std::move(clock));
  }
  const std::string rest = written_yaml(parameters_of(keys, &given));
  const std::size_t head = rest.find('\n') + 1;  // the format

  std::string text = rest.substr(0, head), expect;
  if (!scenario.empty()) text += "scenario:  # the world\n" + indented(scenario, kMargin);
  text += "processes:  # which processes run together\n";
  for (const ProcessSpec& process : launch.processes) {
    const std::string written = config_of(process);
    if (process.name == "expect") {
      expect = written.empty() ? block_yaml(process.config.root) : written;
      continue;
    }
    text += kMargin + process.name + ":\n" + stanza_of(with_own_paths(process, launch.file));
    const std::string config = written.empty() ? block_yaml(process.config.root) : written;
    if (!config.empty()) text += kMargin + kMargin + "config:\n" + indented(config, kMargin + kMargin + kMargin);
  }
  text += rest.substr(head);
  if (expect.empty() && !launch.exits.empty()) expect = "expect:  # what must hold for the run to succeed\n";
  ConfigNode exits;
  exits.kind = ConfigNode::Kind::kList;
  for (const ExitExpectation& exit : launch.exits) exits.items.push_back(exit.given);
  text += expect + block_yaml(exits, kMargin);
  std::vector<ConfigProblem> problems;
  find_unwritable(launch, parse_config(text, launch.file).root, "", problems);
  if (!problems.empty()) throw ConfigError(std::move(problems));
  return text;
}

}  // namespace ensonify
