#include "components/runtime/lockstep/local_bus.h"

#include <algorithm>

#include "components/errors/exit_error.h"

namespace ensonify {

Conductor conductor_of(const Graph& graph, const std::vector<Declaration>& processes, SimTime window) {
  std::vector<Conductor::Edge> edges;
  for (const Graph::Edge& e : graph.edges) edges.push_back({graph.topics[e.topic].publisher, e.to, e.delay});
  std::vector<bool> may_finish;
  for (const Declaration& d : processes) may_finish.push_back(d.may_finish);
  return {processes.size(), std::move(edges), std::move(may_finish), window};
}

void LocalBus::add(const std::string& process, const std::string& component, const std::filesystem::path& out_dir,
                   const MakeNode& make) {
  members_.push_back(std::make_unique<Session>(component, process, out_dir, make));
  declarations_.push_back(members_.back()->declaration());
}

void LocalBus::connect(const std::vector<WireRule>& rules, const std::map<std::string, std::string>& places,
                       const std::map<std::string, std::string>& facts) {
  graph_ = wire(declarations_, rules, places);
  if (!graph_.problems.empty()) {
    std::string all;
    for (const std::string& problem : graph_.problems) all += (all.empty() ? "" : "\n") + problem;
    throw UserError(all);
  }
  std::vector<std::vector<Stepper*>> subscribers(graph_.topics.size());
  for (const Graph::Edge& edge : graph_.edges) {
    std::vector<Stepper*>& of_topic = subscribers[edge.topic];
    Stepper* subscriber = &members_[edge.to]->stepper();
    if (std::find(of_topic.begin(), of_topic.end(), subscriber) == of_topic.end()) of_topic.push_back(subscriber);
  }
  for (std::size_t rank = 0; rank < members_.size(); ++rank) {
    std::vector<OutTopic> outs;
    for (std::size_t t = 0; t < graph_.topics.size(); ++t) {
      if (graph_.topics[t].publisher == rank) outs.push_back({graph_.topics[t].name, static_cast<std::uint32_t>(t)});
    }
    members_[rank]->stepper().wire(feeds_of(graph_, declarations_, rank), std::move(outs), facts, 1,
                                   static_cast<std::uint32_t>(rank), [subscribers](msg::Packet&& packet) {
                                     for (Stepper* s : subscribers[packet.envelope.topic_id]) s->insert(packet);
                                   });
  }
}

bool LocalBus::advance(Conductor& conductor) {
  const auto grants = conductor.grants();
  for (const Conductor::Grant& grant : grants) {
    Stepper& stepper = members_[grant.participant]->stepper();
    const bool finish = stepper.run_to(grant.horizon);
    if (finish && !finished_at_) finished_at_ = stepper.last();
    if (finish) conductor.end_at(stepper.last() + kFinishMargin);
    conductor.done(grant.participant, finish ? stepper.last() + SimTime{1} : stepper.next());
  }
  return !grants.empty();
}

int LocalBus::finish() {
  int code = 0;
  for (const auto& member : members_) {
    member->node().finish_run();
    if (code == 0) code = member->node().exit_code();
  }
  return code;
}

}  // namespace ensonify
