#include "tools/graph/picture.h"

#include <algorithm>
#include <optional>
#include <string>

namespace ensonify::graph_tool {
namespace {

std::size_t index_of(const Picture& picture, const std::string& process) {
  const auto found = std::find_if(picture.processes.begin(), picture.processes.end(),
                                  [&](const Picture::Process& p) { return p.name == process; });
  return static_cast<std::size_t>(found - picture.processes.begin());
}

}  // namespace

Picture picture_of(const Graph& graph, const std::vector<Declaration>& processes) {
  Picture picture;
  for (const Declaration& d : processes) picture.processes.push_back({d.process, d.component});
  for (const Graph::Topic& t : graph.topics) {
    picture.topics.push_back({t.name, t.type, t.publisher, t.max_bytes, t.rate});
  }
  for (const Graph::Edge& e : graph.edges) {
    picture.edges.push_back({e.topic, e.to, processes[e.to].ins[e.in_port].port, e.delay});
  }
  std::stable_sort(picture.edges.begin(), picture.edges.end(),
                   [](const auto& a, const auto& b) { return a.topic < b.topic; });  // as the registry lists them
  return picture;
}

Picture picture_of(const RunRegistry& registry) {
  Picture picture;
  for (const auto& [name, component] : registry.processes) picture.processes.push_back({name, component});
  for (const TopicEntry& topic : registry.topics) {
    if (index_of(picture, topic.publisher) == picture.processes.size()) continue;  // the clock: no edge leads there
    for (const auto& [process, port, delay] : topic.subscribers) {
      picture.edges.push_back({picture.topics.size(), index_of(picture, process), port, delay});
    }
    picture.topics.push_back({topic.name, topic.type, index_of(picture, topic.publisher), topic.max_bytes, topic.rate});
  }
  return picture;
}

Picture without_health(const Picture& picture) {
  Picture kept{picture.processes, {}, {}};
  std::vector<std::optional<std::size_t>> new_index(picture.topics.size());
  for (std::size_t t = 0; t < picture.topics.size(); ++t) {
    const bool read =
        std::any_of(picture.edges.begin(), picture.edges.end(), [t](const auto& e) { return e.topic == t; });
    if (picture.topics[t].type == "health/1" && !read) continue;
    new_index[t] = kept.topics.size();
    kept.topics.push_back(picture.topics[t]);
  }
  for (Picture::Edge edge : picture.edges) {
    edge.topic = *new_index[edge.topic];
    kept.edges.push_back(edge);
  }
  return kept;
}

}  // namespace ensonify::graph_tool
