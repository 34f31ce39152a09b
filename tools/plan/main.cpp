// ensonify plan: surveys before they are run.
#include <CLI/CLI.hpp>
#include <stdexcept>

#include "components/errors/exit_error.h"
#include "components/runtime/tool.h"
#include "tools/plan/verbs.h"

int main(int argc, char** argv) {
  using namespace ensonify;
  CLI::App app(
      "Plans surveys: lines over an area, how fast to run for a feature, a towfish's altitude; imports lines that "
      "survey "
      "software wrote. Missions are written as mission/1, which a scenario's mission.file names.\nExit code: 0 done, 2 "
      "wrong input.",
      "ensonify plan");
  app.require_subcommand(1);
  const std::vector<plan::Verb> verbs = {plan::add_lines(app), plan::add_speed(app), plan::add_sidescan(app),
                                         plan::add_import(app)};
  return tool_main(app, argc, argv, [&]() -> int {
    for (const auto& verb : verbs) {
      if (!verb.app->parsed()) continue;
      try {
        return verb.run();
      } catch (const std::invalid_argument& error) {  // a kernel refuses
        throw UserError(error.what());
      }
    }
    return kExitOk;
  });
}
