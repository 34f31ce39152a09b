// ensonify-check: is a launch file sound? Nothing is run but the programs' own --check.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "components/config/data_paths.h"
#include "components/errors/printable.h"
#include "components/runtime/declared.h"
#include "components/runtime/tool.h"
#include "components/terrain/layers_source.h"
#include "launch/check_ports.h"
#include "launch/file/launch_file.h"
#include "scenarios/world/world.h"

namespace {

using namespace ensonify;
using namespace ensonify::launcher;

/// Guides are read for it, so it is for launches whose pager reads them too: what it refuses has been reported already.
void append_uneven(const Launch& launch, const World& world, std::vector<std::string>& warnings) {
  const bool paged = std::ranges::any_of(
      launch.processes, [](const ProcessSpec& process) { return process.component == "terrain_pager"; });
  if (!paged || launch.scenario.path.empty() || world.seabed.kind != Seabed::Kind::kLayers) return;
  const source::LayersSource seabed(world.seabed, world.site.origin);
  for (const auto& uneven : seabed.meshed_relief().uneven) warnings.push_back(text_of(uneven));
}

/// What a program says with --print.
std::string asked(const Launch& launch, const ProcessSpec& process, const RunPlaces& places) {
  if (!process.argv.empty() || process.external) return "";
  std::string command;
  Command words = process_command(launch, process, places, "");
  words.argv.emplace_back("--print");
  for (const std::string& word : words.argv) {
    command += "'";
    for (const char c : word) command += c == '\'' ? std::string("'\\''") : std::string(1, c);
    command += "' ";
  }
  std::string text;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw UserError(process.name + ": its program cannot be started");
  char buffer[4096];
  for (std::size_t got = 0; (got = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) text.append(buffer, got);
  if (::pclose(pipe) != 0) throw UserError(process.name + ": its program does not print its configuration");
  return text;
}

/// The launch as it is when it runs, with every value. `$(out)` stays.
void print(LaunchOptions options) {
  options.out = "$(out)";
  std::string scenario;
  const Launch launch =
      read_launch(options, [&](ConfigReader& from, const std::string& file) { read_world(from, file, &scenario); });
  const RunPlaces places{program_folder(), "", options.out};
  fmt::print("{}", written_launch(launch, scenario,
                                  [&](const ProcessSpec& process) { return asked(launch, process, places); }));
}

int check(const LaunchOptions& options, bool as_json, bool as_print) {
  CheckedPorts checked;
  std::vector<std::string> warnings;
  std::size_t processes = 0;
  try {
    World world;
    const Launch launch =
        read_launch(options, [&](ConfigReader& from, const std::string& file) { world = read_world(from, file); });
    processes = launch.processes.size();
    const RunPlaces places{program_folder(), "", options.out};
    checked = check_ports(launch, places);
    try {
      check_after(launch, places);
    } catch (const ConfigError& error) {
      for (const auto& problem : error.problems()) checked.problems.push_back(problem.text());
    }
    for (const auto& found : {wiring_problems(launch, checked), unpaged_mission_problems(launch, places),
                              setting_problems(world.mission, checked)})
      checked.problems.insert(checked.problems.end(), found.begin(), found.end());
    warnings = resolution_warnings(checked);
    if (checked.problems.empty()) append_uneven(launch, world, warnings);
    for (const auto& name : checked.unknown) {
      warnings.push_back(name + ": its ports are not known before it runs, so the wiring was not checked");
    }
  } catch (const ConfigError& error) {
    for (const auto& problem : error.problems()) {
      checked.problems.push_back(problem.text());
    }
  }
  if (as_json) {
    const auto declarations = nlohmann::ordered_json::parse(declarations_json(checked.declarations));
    const nlohmann::ordered_json answer = {
        {"problems", checked.problems}, {"warnings", warnings}, {"declarations", declarations}};
    fmt::print("{}\n", answer.dump(2));
  } else {
    for (const auto& problem : checked.problems) {
      fmt::print(stderr, "{}\n", printable(problem));
    }
    for (const auto& warning : warnings) {
      fmt::print(stderr, "warning: {}\n", printable(warning));
    }
    if (checked.problems.empty() && as_print) print(options);
    if (checked.problems.empty() && !as_print) {
      fmt::print("{}: {} processes, valid\n", options.file, processes);
    }
  }
  return checked.problems.empty() ? kExitOk : kExitUserError;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("ensonify check: reads a launch file, its scenario and every configuration, and checks the wiring.");
  app.name("ensonify check");
  LaunchOptions options;
  bool as_json = false, as_print = false;
  add_options(app, options, true);
  auto* json = app.add_flag("--json", as_json, "print problems and warnings as JSON");
  app.add_flag(
         "--print", as_print,
         "print the launch with its scenario as one file: includes, arguments and changes put in, every value with "
         "its sentence and unit")
      ->excludes(json);
  if (const auto code = parse_command_line(app, argc, argv)) return *code;
  try {
    return check(options, as_json, as_print);
  } catch (const ExitError& error) {
    fmt::print(stderr, "{}\n", printable(error.what()));
    return error.code;
  } catch (const std::exception& error) {
    fmt::print(stderr, "ensonify check: {}\n", error.what());
    return kExitDied;
  }
}
