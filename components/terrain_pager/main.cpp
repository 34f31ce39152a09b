#include <CLI/CLI.hpp>
#include <string_view>

#include "components/config/config_reader.h"
#include "components/errors/exit_code.h"
#include "components/errors/exit_error.h"
#include "components/runtime/tool.h"
#include "components/terrain_pager/mission_track.h"
#include "components/terrain_pager/node.h"
#include "launch/file/launch_file.h"
#include "launch/process/run.h"

namespace {

using namespace ensonify;

/// For launches without a pager: `ensonify-terrain_pager --check-mission --launch FILE ...` says what the seabed has
/// against the mission, with exit code 2, or nothing.
int check_mission(int argc, char** argv) {
  CLI::App app("ensonify-terrain_pager --check-mission: holds a launch's mission against its scenario's seabed.");
  LaunchOptions options;
  add_options(app, options, false);
  if (const auto code = parse_command_line(app, argc, argv)) return *code;
  return exit_code_of([&] {
    const Launch launch = read_launch(options);
    auto defaults = ConfigReader::from_text("{}", options.file);
    pager::check_mission_alone(TerrainPagerConfig::read(defaults, World::read(launch.scenario), ""));
    return kExitOk;
  });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "--check-mission") return check_mission(argc - 1, argv + 1);
  return run<TerrainPagerNode>(argc, argv);
}
