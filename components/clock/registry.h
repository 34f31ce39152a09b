#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "components/runtime/protocol.h"
#include "launch/file/launch_file.h"

namespace ensonify::clock {

/// Participants of the run, checked as a whole before time starts. One address to know for everybody.
class Registry {
 public:
  explicit Registry(const Launch& launch);

  /// The same processes are to join again, for another epoch, as `launch` has them. Their edges stay proven.
  void begin(const Launch& launch, std::uint32_t epoch);

  /// Takes a HELLO; an answer other than "" says why it is refused.
  std::string join(const std::string& from, const protocol::Hello& hello);
  /// Names of processes that have not said HELLO.
  std::vector<std::string> missing() const;
  bool complete() const { return missing().empty(); }

  /// Those that cannot begin another epoch.
  std::vector<std::string> fixed() const;

  /// Checks the wiring of all; problems are empty when it is sound, and in a later epoch that of the first. After this
  /// the graph stands.
  const std::vector<std::string>& check();
  protocol::Welcome welcome(std::size_t rank) const;
  /// The edge of this token delivers, says its publisher. A SUB socket sends its subscriptions to everybody it is
  /// connected to, so the same token reported by another process proves nothing.
  void proven(const std::string& from, const std::string& token);
  /// In a later epoch: this process has read its WELCOME.
  void is_ready(std::size_t rank);
  bool ready() const { return unproven_.empty() && unready_.empty(); }
  /// "bow/ping -> recorder" for each edge that has not been proven, the name of each process that is not ready.
  std::vector<std::string> unproven() const;

  const Graph& graph() const { return graph_; }
  const std::vector<Declaration>& declarations() const { return declarations_; }
  const std::vector<protocol::Hello>& hellos() const { return joined_; }
  std::optional<std::size_t> rank_of(const std::string& name) const;
  /// The rank of a process that has said HELLO.
  std::optional<std::size_t> participant(const std::string& name) const;
  /// Whether a topic of `publisher` goes to `subscriber`.
  bool feeds(std::size_t publisher, std::size_t subscriber) const;
  std::size_t size() const { return declarations_.size(); }
  const std::map<std::string, std::string>& facts() const { return facts_; }

 private:
  static std::string token_of(std::size_t edge) { return "e" + std::to_string(edge); }
  bool joined(std::size_t rank) const { return epochs_[rank] == epoch_; }

  std::vector<std::string> names_;  // in the order of ranks
  std::vector<WireRule> rules_;
  std::map<std::string, std::string> places_;
  std::vector<protocol::Hello> joined_;
  std::vector<std::uint32_t> epochs_;  // that each has joined last; 0: none
  std::uint32_t epoch_ = 1;
  std::vector<Declaration> declarations_;
  Graph graph_;
  Graph first_;  // that of the first epoch, which sockets were made for
  std::vector<Declaration> first_declarations_;
  std::map<std::string, std::string> unproven_;  // token, publisher
  std::set<std::size_t> unready_;                // ranks
  std::map<std::string, std::string> facts_;
  std::set<std::string> may_be_lost_;
  double patience_s_ = 0.0;
};

}  // namespace ensonify::clock
