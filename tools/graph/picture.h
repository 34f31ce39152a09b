#pragma once

#include <string>
#include <vector>

#include "components/runtime/clock_client.h"
#include "components/runtime/wiring.h"

namespace ensonify::graph_tool {

/// Graph of publishers and subscribers: what is drawn, whether it comes from a launch file or from a live run.
struct Picture {
  struct Process {
    std::string name;
    std::string component;
    bool ports_known = true;
  };
  struct Topic {
    std::string name;
    std::string type;
    std::size_t publisher = 0;  // index in processes
    std::size_t max_bytes = 0;
    Rate rate;  // highest declared; {0}: not periodic
  };
  struct Edge {
    std::size_t topic = 0;  // index in topics
    std::size_t to = 0;     // index in processes
    std::string port;
    SimTime delay{0};
  };
  std::vector<Process> processes;
  std::vector<Topic> topics;
  std::vector<Edge> edges;
};

Picture picture_of(const Graph& graph, const std::vector<Declaration>& processes);
Picture picture_of(const RunRegistry& registry);

/// Without the topics of type health/1 that nobody reads: every process has one.
Picture without_health(const Picture& picture);

}  // namespace ensonify::graph_tool
