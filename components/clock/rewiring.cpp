#include "components/clock/rewiring.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace ensonify::clock {
namespace {

constexpr std::size_t kAlwaysCarried = std::size_t{1} << 24;  // as a foreign client may have it: docs/manual/wire.md

using Names = std::set<std::string>;

Names topics_of(const Graph& graph) {
  Names names;
  for (const Graph::Topic& topic : graph.topics) names.insert(topic.name + " of type " + topic.type);
  return names;
}

Names edges_of(const Graph& graph, const std::vector<Declaration>& processes) {
  Names names;
  for (const Graph::Edge& edge : graph.edges) {
    const Declaration& reader = processes[edge.to];
    names.insert(graph.topics[edge.topic].name + " read by " + reader.process + "." + reader.ins[edge.in_port].port);
  }
  return names;
}

void compare(const Names& before, const Names& now, std::vector<std::string>& lines) {
  for (const std::string& name : now) {
    if (!before.contains(name)) lines.push_back(name + ": is new; only a new launch can have it");
  }
  for (const std::string& name : before) {
    if (!now.contains(name)) lines.push_back(name + ": is gone; only a new launch can do without");
  }
}

}  // namespace

std::vector<std::string> rewired(const Graph& first, const std::vector<Declaration>& first_processes, const Graph& now,
                                 const std::vector<Declaration>& processes) {
  std::vector<std::string> lines;
  compare(topics_of(first), topics_of(now), lines);
  compare(edges_of(first, first_processes), edges_of(now, processes), lines);
  if (!lines.empty()) return lines;
  for (std::size_t i = 0; i < now.topics.size(); ++i) {
    const std::size_t most = std::max(first.topics[i].max_bytes, kAlwaysCarried);
    if (now.topics[i].max_bytes > most)
      lines.push_back(fmt::format("{}: up to {} bytes, where this launch carries {}; only a new launch can have it",
                                  now.topics[i].name, now.topics[i].max_bytes, most));
  }
  return lines;
}

}  // namespace ensonify::clock
