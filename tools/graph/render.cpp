#include "tools/graph/render.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <memory>

#include "components/errors/exit_error.h"
#include "launch/child.h"

extern char** environ;

namespace ensonify::graph_tool {

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

}  // namespace ensonify::graph_tool
