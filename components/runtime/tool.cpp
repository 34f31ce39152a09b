#include "components/runtime/tool.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "components/errors/exit_error.h"
#include "components/errors/printable.h"
#include "components/runtime/version.h"

namespace ensonify {

namespace {

volatile std::sig_atomic_t interrupts = 0;

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupts = 1; };
  action.sa_flags = 0;  // no restart: waiting calls come back
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_DFL);
}

/// What was printed must have arrived: a full disk behind `>` is not success.
int flushed(int code) {
  return code == kExitOk && (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) ? kExitDataLost : code;
}

/// A signal may be what made a call fail.
int failed(const CLI::App& app, int code, const char* why) {
  if (interrupted()) return kExitInterrupted;
  std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), printable(why).c_str());
  return code;
}

/// NaN is inside every range, as comparisons go; no number that is typed means it, nor infinity.
void ask_for_finite_numbers(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (option->get_type_name().find("FLOAT") == std::string::npos) continue;
    option->check([](const std::string& text) {
      const double value = std::strtod(text.c_str(), nullptr);  // what is no number at all is given when it is parsed
      return std::isfinite(value) ? std::string{} : text + " is not a finite number";
    });
  }
  for (CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) ask_for_finite_numbers(*verb);
}

void add_version_flag(CLI::App& app) {
  app.set_version_flag("--version", std::string("ensonify ") + kVersion, "print the version of Ensonify and exit");
  for (CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) add_version_flag(*verb);
}

}  // namespace

bool interrupted() { return interrupts != 0; }

std::optional<int> parse_command_line(CLI::App& app, int argc, char** argv) {
  add_version_flag(app);
  ask_for_finite_numbers(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    app.exit(e);
    return kExitUserError;
  }
  return std::nullopt;
}

int tool_main(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
  if (const auto code = parse_command_line(app, argc, argv)) return *code;
  catch_interrupts();
  try {
    const int code = flushed(body());
    return interrupted() ? kExitInterrupted : code;
  } catch (const ExitError& e) {
    return failed(app, e.code, e.what());
  } catch (const std::exception& e) {
    return failed(app, kExitDied, e.what());
  }
}

}  // namespace ensonify
