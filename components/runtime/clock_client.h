#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "components/runtime/bus/router.h"
#include "components/runtime/sim_time.h"

namespace CLI {
class App;
}

namespace ensonify {

/// Entry of the clock's registry for a topic.
struct TopicEntry {
  struct Subscriber {
    std::string process;
    std::string port;
    SimTime delay{0};
  };
  std::string name;
  std::string type;
  std::string publisher;
  std::string component;  // of the publisher
  std::size_t max_bytes = 0;
  Rate rate;               // highest rate declared; {0}: not periodic
  std::string endpoint;    // of the live plane
  bool live_only = false;  // for viewers: no participant and no record reads it
  std::uint64_t published = 0;
  std::vector<Subscriber> subscribers;
};

/// The clock's registry: who is in the run, and every topic in the order of topic ids.
struct RunRegistry {
  struct Process {
    std::string name;
    std::string component;
  };
  std::vector<Process> processes;
  std::vector<TopicEntry> topics;
};

/// Throws std::runtime_error naming what is wrong with the text.
RunRegistry read_registry(const nlohmann::json& answer);

struct LiveRun;

/// Asks a live run's clock (docs/manual/wire.md, "Control: asking").
class ClockClient {
 public:
  /// Finds the run (run_finder.h). Throws UserError.
  explicit ClockClient(const std::string& run);
  explicit ClockClient(const LiveRun& run);

  const std::string& endpoint() const { return endpoint_; }
  /// For sockets of one's own; nothing where the run needs none.
  const std::optional<bus::Keys>& keys() const { return keys_; }
  /// The clock's answer. Throws UserError when it refuses, or has not answered within 5 s.
  nlohmann::json ask(const nlohmann::json& request);
  /// Throws UserError while processes are still missing: before that there is no wiring.
  RunRegistry registry();

 private:
  std::string endpoint_;
  std::optional<bus::Keys> keys_;
  bus::ClockQuery query_;
};

/// Adds --run to a tool's options.
void add_run_option(CLI::App& app, std::string& run);

}  // namespace ensonify
