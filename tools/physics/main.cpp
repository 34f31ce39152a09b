// ensonify physics: any kernel's values, for whoever wants to inspect or compare.
#include <CLI/CLI.hpp>

#include "components/errors/exit_error.h"
#include "components/runtime/tool.h"
#include "tools/physics/verb.h"

int main(int argc, char** argv) {
  using namespace ensonify;
  CLI::App app(
      "Prints what the acoustic models give, as CSV with a header, or as JSON. Every input is an option: a number, or\n"
      "a sweep such as 0:100:5; several sweeps make all combinations. Names carry units; levels are dB re 1 uPa^2.\n"
      "Exit code: 0 done, 2 wrong input.",
      "ensonify physics");
  app.require_subcommand(1);
  physics::Verbs verbs;
  physics::add_absorption(app, verbs);
  physics::add_backscatter(app, verbs);
  physics::add_disturbance(app, verbs);
  physics::add_level(app, verbs);
  physics::add_material(app, verbs);
  physics::add_multipath(app, verbs);
  physics::add_noise(app, verbs);
  physics::add_pattern(app, verbs);
  physics::add_ray(app, verbs);
  physics::add_receiver(app, verbs);
  physics::add_relief(app, verbs);
  physics::add_sound_speed(app, verbs);
  physics::add_stabilisation(app, verbs);
  physics::add_statistics(app, verbs);
  physics::add_surface(app, verbs);
  physics::add_tide(app, verbs);
  return tool_main(app, argc, argv, [&] {
    for (physics::Verb& verb : verbs) {
      if (verb.asked_for()) verb.print();
    }
    return static_cast<int>(kExitOk);
  });
}
