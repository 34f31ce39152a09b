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

int check(const LaunchOptions& options, bool as_json) {
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
    if (checked.problems.empty()) {
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
  bool as_json = false;
  add_options(app, options, true);
  app.add_flag("--json", as_json, "print problems and warnings as JSON");
  if (const auto code = parse_command_line(app, argc, argv)) return *code;
  try {
    return check(options, as_json);
  } catch (const ExitError& error) {
    fmt::print(stderr, "{}\n", printable(error.what()));
    return error.code;
  } catch (const std::exception& error) {
    fmt::print(stderr, "ensonify check: {}\n", error.what());
    return kExitDied;
  }
}
