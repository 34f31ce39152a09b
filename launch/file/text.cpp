
#include <CLI/CLI.hpp>

#include "components/config/config_text.h"
#include "launch/file/injections.h"
#include "launch/file/launch_file.h"

namespace ensonify {

std::string canonical_text(const Launch& launch) {
  ConfigNode root = ConfigNode::map();
  root.set("ensonify", ConfigNode::text(kLaunchFormat));
  ConfigNode processes = ConfigNode::map();
  for (const auto& process : launch.processes) {
    ConfigNode stanza = ConfigNode::map();
    ConfigNode run = ConfigNode::text(process.component);
    if (!process.argv.empty()) {
      run = ConfigNode{};
      run.kind = ConfigNode::Kind::kList;
      for (const auto& word : process.argv) {
        run.items.push_back(ConfigNode::text(word));
      }
    }
    stanza.set("run", std::move(run));
    if (process.may_be_lost) stanza.set("may_be_lost", ConfigNode::text("true"));
    ConfigNode config = process.config.root;
    if (process.place.file == "--record") {  // the same run in another file is the same run
      config.entries.erase(config.entries.begin());
    }
    stanza.set("config", std::move(config));
    processes.set(process.name, std::move(stanza));
  }
  root.set("processes", std::move(processes));
  ConfigNode wiring = ConfigNode::map();
  for (const auto& connection : launch.wiring) {
    ConfigNode edge = ConfigNode::map();
    edge.set("topic", ConfigNode::text(connection.topic));
    if (connection.delay) {
      edge.set("delay_ns", ConfigNode::text(std::to_string(connection.delay->count())));
    }
    wiring.entries.push_back({connection.process + "." + connection.port, {}, std::move(edge)});
  }
  root.set("wiring", std::move(wiring));
  if (!launch.injections.empty()) root.set("inject", node_of(launch.injections));
  if (launch.isa) root.set("isa", ConfigNode::text(name_of(*launch.isa)));
  if (launch.duration) {
    root.set("duration_ns", ConfigNode::text(std::to_string(launch.duration->count())));
  }
  return to_canonical_yaml(root);
}

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
