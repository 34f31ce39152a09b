#include "launch/file/text.h"

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
    wiring.set(connection.process + "." + connection.port, std::move(edge));
  }
  root.set("wiring", std::move(wiring));
  if (launch.duration) {
    root.set("duration_ns", ConfigNode::text(std::to_string(launch.duration->count())));
  }
  return to_canonical_yaml(root);
}

}  // namespace ensonify
