#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/runtime/lockstep/conductor.h"
#include "components/runtime/session.h"
#include "components/runtime/wiring.h"

namespace ensonify {

/// Conductor of a wiring: who waits for whom.
Conductor conductor_of(const Graph& graph, const std::vector<Declaration>& processes, SimTime window);

/// Nodes in one thread and the bus between them: a published packet goes straight into its subscribers' queues.
class LocalBus {
 public:
  /// A process more, of the next rank; `make` constructs its node, which declares its ports.
  void add(const std::string& process, const std::string& component, const std::filesystem::path& out_dir,
           const MakeNode& make);

  /// Wires all that were added. Throws UserError with everything that is wrong, a line each.
  void connect(const std::vector<WireRule>& rules, const std::map<std::string, std::string>& places,
               const std::map<std::string, std::string>& facts);

  /// Runs what the conductor grants now; false where it grants nothing.
  bool advance(Conductor& conductor);

  /// Ends the run in order; the exit code is the first that is not 0.
  int finish();

  const Graph& graph() const { return graph_; }
  const std::vector<Declaration>& declarations() const { return declarations_; }
  /// Time of the event that asked for the end of the run.
  const std::optional<SimTime>& finished_at() const { return finished_at_; }

 private:
  std::vector<std::unique_ptr<Session>> members_;
  std::vector<Declaration> declarations_;
  Graph graph_;
  std::optional<SimTime> finished_at_;
};

}  // namespace ensonify
