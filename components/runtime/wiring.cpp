#include "components/runtime/wiring.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "components/errors/nearest_name.h"
#include "components/runtime/ports.h"
#include "messages/schema.h"

namespace ensonify {
namespace {

std::string did_you_mean(const std::string& name, const std::vector<std::string>& candidates) {
  const std::string near = nearest_name(name, candidates);
  return near.empty() ? "" : " (did you mean " + near + "?)";
}

/// Whether an output may be for an input that no rule names. One that is called after an input and a process, as
/// settings_bow, is for that input of that process alone.
bool may_be_for(const std::string& out, const std::string& in, const std::string& process) {
  return !out.starts_with(in + "_") || out == in + "_" + process;
}

class Wirer {
 public:
  Wirer(const std::vector<Declaration>& processes, const std::vector<WireRule>& rules,
        const std::map<std::string, std::string>& places)
      : processes_(processes), rules_(rules), places_(places) {}

  Graph run() {
    list_topics();
    check_types();
    check_rules();
    for (std::size_t rank = 0; rank < processes_.size(); ++rank) {
      for (std::size_t in = 0; in < processes_[rank].ins.size(); ++in) connect(rank, in);
    }
    find_undelayed_cycle();
    return std::move(graph_);
  }

 private:
  void problem(const std::string& text) { graph_.problems.push_back(text); }
  std::string input_name(std::size_t rank, std::size_t in) const {
    return processes_[rank].process + "." + processes_[rank].ins[in].port;
  }

  /// An input that no rule names, for messages.
  std::string placed_name(std::size_t rank, std::size_t in) const {
    return placed(processes_[rank].process) + "." + processes_[rank].ins[in].port;
  }
  std::string placed(const std::string& process) const {
    const auto place = places_.find(process);
    return (place == places_.end() ? "" : place->second + ": ") + process;
  }

  void list_topics() {
    for (std::size_t rank = 0; rank < processes_.size(); ++rank) {
      for (std::size_t other = 0; other < rank; ++other) {
        if (processes_[other].process == processes_[rank].process) {
          problem(processes_[rank].process +
                  ": two processes have this name, so two publishers would share its topics");
        }
      }
      for (std::size_t port = 0; port < processes_[rank].outs.size(); ++port) {
        const OutPort& out = processes_[rank].outs[port];
        graph_.topics.push_back(
            {processes_[rank].process + "/" + out.port, rank, port, out.type, out.max_bytes, out.rate});
        topic_names_.push_back(graph_.topics.back().name);
      }
    }
  }

  /// Types of ours in a version that this program does not know; other names are other people's affair.
  void check_types() {
    for (std::size_t rank = 0; rank < processes_.size(); ++rank) {
      for (const OutPort& out : processes_[rank].outs) check_type(rank, out.port, out.type);
      for (const InPort& in : processes_[rank].ins) check_type(rank, in.port, in.type);
    }
  }
  void check_type(std::size_t rank, const std::string& port, const std::string& type) {
    if (msg::find_type(type) != nullptr) return;
    const std::string_view name = std::string_view(type).substr(0, type.find('/') + 1);
    for (const msg::TypeInfo& known : msg::message_types()) {
      if (!name.empty() && known.type.starts_with(name))
        problem(placed(processes_[rank].process) + "/" + port + ": type " + type +
                " is of an unknown version; known: " + known.type);
    }
  }

  void check_rules() {
    std::vector<std::string> inputs;
    for (std::size_t rank = 0; rank < processes_.size(); ++rank) {
      for (std::size_t in = 0; in < processes_[rank].ins.size(); ++in) inputs.push_back(input_name(rank, in));
    }
    std::set<std::string> wired;
    for (const WireRule& rule : rules_) {
      if (rule.input.empty()) {
        if (std::find(topic_names_.begin(), topic_names_.end(), rule.topic) == topic_names_.end())
          problem(rule.place + ": no process publishes " + rule.topic + did_you_mean(rule.topic, topic_names_));
        continue;
      }
      if (std::find(inputs.begin(), inputs.end(), rule.input) == inputs.end()) {
        problem(rule.place + ": wiring." + rule.input + ": no process has this input" +
                did_you_mean(rule.input, inputs));
      }
      if (!wired.insert(rule.input).second) {
        problem(rule.place + ": wiring." + rule.input + ": wired twice, two publishers");
      }
    }
  }

  void connect(std::size_t rank, std::size_t in) {
    const InPort& port = processes_[rank].ins[in];
    const std::string name = input_name(rank, in);
    const auto rule = std::find_if(rules_.begin(), rules_.end(), [&](const WireRule& r) { return r.input == name; });
    if (!port.topics.empty()) {
      connect_listed(rank, in);
    } else if (rule != rules_.end()) {
      connect_named(rank, in, rule->topic, *rule);
    } else {
      connect_only_publisher(rank, in);
    }
  }

  void connect_listed(std::size_t rank, std::size_t in) {
    const InPort& port = processes_[rank].ins[in];
    for (const std::string& wanted : port.topics) {
      bool any = is_pattern(wanted);
      for (std::size_t t = 0; t < graph_.topics.size(); ++t) {
        const std::size_t publisher = graph_.topics[t].publisher;
        if (publisher == rank || !topic_matches(wanted, graph_.topics[t].name)) continue;
        // Two that watch everything would wait for each other's health: by pattern, watchers do not watch watchers.
        if (port.type == "*" && is_pattern(wanted) && watches_by_pattern(publisher)) continue;
        any = true;
        if (port.type != "*" && graph_.topics[t].type != port.type) {
          if (is_pattern(wanted)) continue;
          problem(placed_name(rank, in) + ": " + wanted + " is " + graph_.topics[t].type + ", the input takes " +
                  port.type);
        }
        const bool already = std::any_of(graph_.edges.begin(), graph_.edges.end(), [&](const Graph::Edge& e) {
          return e.topic == t && e.to == rank && e.in_port == in;
        });
        if (!already) add_edge(t, rank, in, port.delay);
      }
      if (!any) {
        problem(placed_name(rank, in) + ": no process publishes " + wanted + did_you_mean(wanted, topic_names_));
      }
    }
  }

  bool watches_by_pattern(std::size_t rank) const {
    const auto& ins = processes_[rank].ins;
    return std::any_of(ins.begin(), ins.end(), [](const InPort& port) {
      return port.type == "*" && std::any_of(port.topics.begin(), port.topics.end(), is_pattern);
    });
  }

  void connect_named(std::size_t rank, std::size_t in, const std::string& topic, const WireRule& rule) {
    const InPort& port = processes_[rank].ins[in];
    const std::string where = rule.place + ": wiring." + rule.input + ": ";
    const auto found = std::find(topic_names_.begin(), topic_names_.end(), topic);
    if (found == topic_names_.end()) {
      problem(where + "no process publishes " + topic + did_you_mean(topic, topic_names_));
      return;
    }
    const auto t = static_cast<std::size_t>(found - topic_names_.begin());
    if (graph_.topics[t].type != port.type) {
      problem(where + topic + " is " + graph_.topics[t].type + ", the input takes " + port.type);
      return;
    }
    if (rule.delay >= SimTime{0} && rule.delay < port.delay) {
      problem(where + "delay_ms " + std::to_string(rule.delay.count() / 1'000'000) + " is shorter than the port's " +
              std::to_string(port.delay.count() / 1'000'000) + "; a launch file may only lengthen it");
      return;
    }
    add_edge(t, rank, in, std::max(rule.delay, port.delay));
  }

  void connect_only_publisher(std::size_t rank, std::size_t in) {
    const InPort& port = processes_[rank].ins[in];
    std::vector<std::size_t> offers;
    for (std::size_t t = 0; t < graph_.topics.size(); ++t) {
      const Graph::Topic& topic = graph_.topics[t];
      const std::string& out = processes_[topic.publisher].outs[topic.port].port;
      if (topic.type == port.type && topic.publisher != rank && may_be_for(out, port.port, processes_[rank].process)) {
        offers.push_back(t);
      }
    }
    if (offers.size() == 1) {
      add_edge(offers[0], rank, in, port.delay);
    } else if (offers.size() > 1) {
      std::string names;
      for (const std::size_t t : offers) names += (names.empty() ? "" : ", ") + graph_.topics[t].name;
      problem(placed_name(rank, in) + ": several publishers offer " + port.type + " (" + names +
              "); name one under wiring:");
    } else if (!port.optional) {
      problem(placed_name(rank, in) + ": no publisher offers " + port.type + "; allowed: a launch with one");
    }
  }

  void add_edge(std::size_t topic, std::size_t to, std::size_t in, SimTime delay) {
    const Rate has = graph_.topics[topic].rate;
    const Rate least = processes_[to].ins[in].least;
    if (has.num > 0 && has.hz() < least.hz()) {
      problem(fmt::format("{}: needs at least {:g} Hz, and {} has {:g} Hz", placed_name(to, in), least.hz(),
                          graph_.topics[topic].name, has.hz()));
    }
    graph_.edges.push_back({topic, to, in, delay});
  }

  /// Depth first over plain edges; the first cycle found is named.
  void find_undelayed_cycle() {
    std::vector<int> state(processes_.size(), 0);
    std::vector<std::size_t> path;
    for (std::size_t start = 0; start < processes_.size(); ++start) {
      if (state[start] == 0 && visit(start, state, path)) return;
    }
  }
  bool visit(std::size_t rank, std::vector<int>& state, std::vector<std::size_t>& path) {
    state[rank] = 1;
    path.push_back(rank);
    for (const Graph::Edge& edge : graph_.edges) {
      if (graph_.topics[edge.topic].publisher != rank || edge.delay > SimTime{0}) continue;
      if (state[edge.to] == 1) {
        name_cycle(path, edge.to);
        return true;
      }
      if (state[edge.to] == 0 && visit(edge.to, state, path)) return true;
    }
    state[rank] = 2;
    path.pop_back();
    return false;
  }
  void name_cycle(const std::vector<std::size_t>& path, std::size_t back_to) {
    std::string names;
    for (auto it = std::find(path.begin(), path.end(), back_to); it != path.end(); ++it) {
      names += processes_[*it].process + " -> ";
    }
    problem("wiring: " + names + processes_[back_to].process +
            ": a cycle without a delayed edge; give one of its inputs a delay_ms");
  }

  const std::vector<Declaration>& processes_;
  const std::vector<WireRule>& rules_;
  const std::map<std::string, std::string>& places_;
  std::vector<std::string> topic_names_;
  Graph graph_;
};

}  // namespace

Declaration declaration_of(const std::string& component, const Ports& ports) {
  return {ports.process(),         component,        ports.outs(), ports.ins(),
          ports.declares_finish(), ports.declares(), ports.lives()};
}

Graph wire(const std::vector<Declaration>& processes, const std::vector<WireRule>& rules,
           const std::map<std::string, std::string>& places) {
  return Wirer(processes, rules, places).run();
}

std::vector<Feed> feeds_of(const Graph& graph, const std::vector<Declaration>& processes, std::size_t rank) {
  std::vector<Feed> feeds;
  for (const Graph::Edge& edge : graph.edges) {
    if (edge.to != rank) continue;
    const Graph::Topic& topic = graph.topics[edge.topic];
    feeds.push_back({edge.in_port, topic.name, static_cast<std::uint32_t>(edge.topic), topic.type,
                     processes[topic.publisher].process, static_cast<std::uint32_t>(topic.publisher), edge.delay,
                     topic.max_bytes, topic.rate});
  }
  std::sort(feeds.begin(), feeds.end(), [](const Feed& a, const Feed& b) {
    return std::pair(a.in_index, a.topic_id) < std::pair(b.in_index, b.topic_id);
  });
  return feeds;
}

int queue_length(const Declaration& process, SimTime window) {
  constexpr double kUnstatedRateHz = 10.0;
  double messages = 0.0;
  for (const OutPort& out : process.outs) {
    const double rate_hz = out.rate.num > 0 ? out.rate.hz() : kUnstatedRateHz;
    messages += 2.0 + std::ceil(seconds(window) * rate_hz);
  }
  return static_cast<int>(messages);
}

}  // namespace ensonify
