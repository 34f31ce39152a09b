// ensonify terrain: seabeds on disk.
#include <CLI/CLI.hpp>

#include "components/errors/exit_error.h"
#include "components/runtime/tool.h"
#include "tools/terrain/verbs.h"

int main(int argc, char** argv) {
  using namespace ensonify;
  CLI::App app(
      "Seabeds: makes, checks and reads tile sets (docs/manual/tiles.md), draws and measures generated seabeds.\nExit "
      "code: 0 "
      "done, 1 "
      "verify "
      "found a fault, 2 wrong input or a file that cannot be read or written.",
      "ensonify terrain");
  app.require_subcommand(1);
  const std::vector<terrain_tool::Verb> verbs = {
      terrain_tool::add_build(app),  terrain_tool::add_import(app), terrain_tool::add_info(app),
      terrain_tool::add_verify(app), terrain_tool::add_sample(app), terrain_tool::add_plot(app),
      terrain_tool::add_truth(app),  terrain_tool::add_grid(app),   terrain_tool::add_mesh(app),
      terrain_tool::add_lod(app),    terrain_tool::add_marks(app),  terrain_tool::add_facets(app)};
  return tool_main(app, argc, argv, [&] {
    for (const auto& verb : verbs) {
      if (verb.app->parsed()) return verb.run();
    }
    return static_cast<int>(kExitOk);
  });
}
