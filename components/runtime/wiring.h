#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "components/runtime/ports.h"

namespace ensonify {

/// Topic id of what no participant can read.
inline constexpr std::uint32_t kNoTopicId = 0xFFFFFFFF;

/// The ports of one process, as it declares them; the position in the list of processes is its rank.
struct Declaration {
  std::string process;
  std::string component;
  std::vector<OutPort> outs;
  std::vector<InPort> ins;
  bool may_finish = false;
  std::map<std::string, msg::Value> declares = {};  // Ports::declare, by type
  std::vector<LivePort> lives = {};                 // for viewers: in no graph
};

/// Declaration of a process to the others.
Declaration declaration_of(const std::string& component, const Ports& ports);

/// One line of the launch file's `wiring:`.
struct WireRule {
  std::string input;  // "auv.command"; "": none, but the topic must be there
  std::string topic;  // "agent/command"
  SimTime delay{-1};  // negative: as the port declares
  std::string place;  // "demo.yaml:12:3", for messages
};

/// Graph of publishers and subscribers. Topic ids count outputs in the order of ranks and declarations.
struct Graph {
  struct Topic {
    std::string name;
    std::size_t publisher = 0;  // rank
    std::size_t port = 0;       // index among its outs
    std::string type;
    std::size_t max_bytes = 0;
    Rate rate;
  };
  struct Edge {
    std::size_t topic = 0;  // index in topics: the topic id
    std::size_t to = 0;     // rank of the subscriber
    std::size_t in_port = 0;
    SimTime delay{0};
  };
  std::vector<Topic> topics;
  std::vector<Edge> edges;
  std::vector<std::string> problems;  // empty: the wiring is sound
};

/// Checks the whole wiring: misspelt names (with the nearest), no publisher, several publishers of an unwired input's
/// type, type mismatch, a delay shorter than declared, a cycle without a delayed edge. Everything wrong is listed, with
/// its place where one is known: a rule's own, or that of the process's stanza in `places`.
Graph wire(const std::vector<Declaration>& processes, const std::vector<WireRule>& rules,
           const std::map<std::string, std::string>& places = {});

/// Feeds of a subscriber, in the order of in ports and topic ids.
std::vector<Feed> feeds_of(const Graph& graph, const std::vector<Declaration>& processes, std::size_t rank);

/// Messages that may be on their way on a sync socket at once: 2 + window x rate, summed over its topics.
int queue_length(const Declaration& process, SimTime window);

}  // namespace ensonify
