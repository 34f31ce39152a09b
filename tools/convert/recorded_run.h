#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "components/config/config_node.h"
#include "components/runtime/sim_time.h"

namespace ensonify::convert {

/// A logger as the recorded run had it: its parameters, and what its inputs were wired to.
struct RecordedLogger {
  std::string process;
  ConfigNode config = ConfigNode::map();
  std::vector<std::pair<std::string, ConfigNode>> wiring;  // port; topic and delay, as launch files have them
};

/// What a record says of its run, as far as a logger is concerned.
struct RecordedRun {
  std::string file;
  std::string scenario;                                  // text
  std::vector<RecordedLogger> loggers;                   // in the order of its launch file
  std::set<std::pair<std::string, std::string>> topics;  // topic, type: of what loggers read
  SimTime end{0};                                        // of its last message
  std::string truncated;                                 // where and why it ends early; "": it is whole

  bool has(const std::string& topic) const;
  /// Processes that published something that loggers read.
  std::set<std::string> publishers() const;
  /// Heads whose soundings it holds.
  std::set<std::string> heads() const;
};

/// Reads a record through. Throws UserError for one that cannot be read, or whose run had no scenario.
RecordedRun recorded_run(const std::string& file);

}  // namespace ensonify::convert
