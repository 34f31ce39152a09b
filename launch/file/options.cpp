#include <CLI/CLI.hpp>

#include "launch/file/launch_file.h"

namespace ensonify {

void add_options(CLI::App& app, LaunchOptions& options, bool launch_is_positional) {
  app.add_option(launch_is_positional ? "launch" : "--launch", options.file, "launch file (YAML)")->required();
  // One value per option, so that a file name may follow.
  app.add_option("--arg", options.args, "NAME=VALUE: an argument of the launch file; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--set", options.sets, "PROCESS.KEY=VALUE or SECTION.KEY=VALUE: changes a parameter; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--record", options.record, "record the run to this MCAP file");
  app.add_option("--out", options.out, "folder of results")->capture_default_str();
}

std::vector<std::string> to_arguments(const LaunchOptions& options) {
  std::vector<std::string> arguments{"--launch", options.file};
  for (const auto& arg : options.args) {
    arguments.insert(arguments.end(), {"--arg", arg});
  }
  for (const auto& set : options.sets) {
    arguments.insert(arguments.end(), {"--set", set});
  }
  if (!options.record.empty()) {
    arguments.insert(arguments.end(), {"--record", options.record});
  }
  arguments.insert(arguments.end(), {"--out", options.out});
  return arguments;
}

}  // namespace ensonify
