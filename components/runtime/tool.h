#pragma once

#include <functional>
#include <optional>

namespace CLI {
class App;
}

namespace ensonify {

/// Reads the command line of any of our programs, with `--version` for it and each of its verbs, which all print the
/// same: "ensonify 0.1.0". An exit code when the program is to end here: 0 after help, 2 for wrong arguments, which
/// have been reported. NaN and infinities are wrong for every number.
std::optional<int> parse_command_line(CLI::App& app, int argc, char** argv);

/// main() of a tool: reads the command line, runs `body` and gives its exit code. What `body` throws becomes a text on
/// standard error and the exit code that belongs to it; wrong arguments give 2, Ctrl-C gives 130.
///
/// A reader that closes our standard output (`| head`) ends the tool silently, as it does any Unix program.
int tool_main(CLI::App& app, int argc, char** argv, const std::function<int()>& body);

/// True once Ctrl-C or SIGTERM has come; whoever waits for sockets is woken by it.
bool interrupted();

}  // namespace ensonify
