// ensonify graph: who talks to whom, in a launch file or in a live run.
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>

#include "components/config/data_paths.h"
#include "components/errors/exit_error.h"
#include "components/runtime/tool.h"
#include "launch/check_ports.h"
#include "launch/child.h"
#include "launch/file/launch_file.h"
#include "launch/process/launch_wiring.h"
#include "tools/graph/picture.h"
#include "tools/graph/picture_text.h"

extern char** environ;

namespace {

using namespace ensonify;
using namespace ensonify::graph_tool;

struct Options {
  LaunchOptions launch;
  std::string run;
  bool dot = false;
  bool json = false;
  bool all = false;
  std::string svg;
  std::string png;
};

/// What the programs of a launch file say with --check. What is wrong with the wiring is added to `problems`.
Picture picture_of_launch(const LaunchOptions& options, std::vector<std::string>& problems) {
  const Launch launch = read_launch(options);
  const launcher::CheckedPorts checked = launcher::check_ports(launch, {program_folder(), "", options.out});
  if (!checked.problems.empty()) throw UserError(fmt::format("{}", fmt::join(checked.problems, "\n")));
  const Graph graph = wire(checked.declarations, wire_rules(launch));
  problems = launcher::wiring_problems(launch, checked);
  Picture picture = picture_of(graph, checked.declarations);
  for (const ProcessSpec& process : launch.processes) {
    const bool known = std::any_of(picture.processes.begin(), picture.processes.end(),
                                   [&](const auto& p) { return p.name == process.name; });
    if (!known) picture.processes.push_back({process.name, process.component, false});
  }
  return picture;
}

/// Has Graphviz draw `dot` into `file`; `format` is "svg" or "png".
void render(const std::string& dot, const std::string& format, const std::string& file) {
  std::string program = launcher::find_program("dot");
  if (program.empty()) {
    throw UserError("Graphviz is not installed (apt install graphviz); --dot prints what it would draw");
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> input(std::tmpfile(), std::fclose);
  if (!input || std::fputs(dot.c_str(), input.get()) < 0 || std::fflush(input.get()) != 0) {
    throw UserError("the folder for temporary files cannot be written");
  }
  std::rewind(input.get());
  std::string type = "-T" + format;
  std::string out = "-o" + file;
  char* argv[] = {program.data(), type.data(), out.data(), nullptr};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, ::fileno(input.get()), STDIN_FILENO);
  pid_t pid = 0;
  const int error = ::posix_spawn(&pid, program.c_str(), &actions, nullptr, argv, environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw UserError(program + ": cannot be started");
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (status != 0) throw UserError(file + ": Graphviz could not draw it; see its words above");
}

void show(const Picture& picture, const Options& options) {
  if (!options.svg.empty()) render(to_dot(picture), "svg", options.svg);
  if (!options.png.empty()) render(to_dot(picture), "png", options.png);
  if (options.dot) fmt::print("{}", to_dot(picture));
  else if (options.json) fmt::print("{}\n", to_json(picture));
  else if (options.svg.empty() && options.png.empty()) fmt::print("{}", to_text(picture));
}

int graph(const Options& options) {
  std::vector<std::string> problems;
  const Picture picture = options.launch.file.empty() ? picture_of(ClockClient(options.run).registry())
                                                      : picture_of_launch(options.launch, problems);
  show(options.all ? picture : without_health(picture), options);
  for (const std::string& problem : problems) fmt::print(stderr, "{}\n", problem);
  return problems.empty() ? kExitOk : kExitUserError;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Draws who talks to whom: of a launch file, or of a live run when no launch file is named. Each topic with its\n"
      "type, highest rate, largest message and readers; delays are those of delayed edges.\n"
      "Exit code: 0 drawn, 2 a file or the wiring is wrong, or there is no such run.",
      "ensonify graph");
  Options options;
  add_options(app, options.launch, true);
  CLI::Option* launch = app.get_option("launch")->required(false);
  add_run_option(app, options.run);
  app.get_option("--run")->excludes(launch);
  CLI::Option* dot = app.add_flag("--dot", options.dot, "print Graphviz text");
  app.add_flag("--json", options.json, "print JSON; delays in ns, sizes in bytes")->excludes(dot);
  app.add_option("--svg", options.svg, "draw to this file with Graphviz");
  app.add_option("--png", options.png, "draw to this file with Graphviz");
  app.add_flag("--all", options.all, "also the health topics that nobody reads");
  return tool_main(app, argc, argv, [&] { return graph(options); });
}
