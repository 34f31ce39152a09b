#include "tools/graph/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>

#include "components/runtime/sim_time.h"

namespace ensonify::graph_tool {
namespace {

/// "100 Hz"; "" when no rate is declared.
std::string rate_words(Rate rate) { return rate.num > 0 ? fmt::format("{:g} Hz", rate.hz()) : ""; }

/// "512 B", "17 kB", "4.2 MB": powers of ten.
std::string size_words(std::size_t bytes) {
  const auto b = static_cast<double>(bytes);
  return b >= 1e6   ? fmt::format("{:.2g} MB", b * 1e-6)
         : b >= 1e3 ? fmt::format("{:.0f} kB", b * 1e-3)
                    : fmt::format("{} B", bytes);
}

/// "delayed 100 ms"; "" for a plain edge.
std::string delay_words(SimTime delay) {
  return delay > SimTime{0} ? fmt::format("delayed {:g} ms", 1e3 * seconds(delay)) : "";
}

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

std::string to_json(const Picture& picture) {
  using nlohmann::ordered_json;
  ordered_json json = {
      {"processes", ordered_json::array()}, {"topics", ordered_json::array()}, {"edges", ordered_json::array()}};
  for (const auto& p : picture.processes) {
    json["processes"].push_back({{"name", p.name}, {"component", p.component}, {"ports_known", p.ports_known}});
  }
  for (const auto& t : picture.topics) {
    json["topics"].push_back({{"topic", t.name},
                              {"type", t.type},
                              {"publisher", picture.processes[t.publisher].name},
                              {"max_bytes", t.max_bytes},
                              {"rate_hz", t.rate.num > 0 ? ordered_json(t.rate.hz()) : ordered_json(nullptr)}});
  }
  for (const auto& e : picture.edges) {
    json["edges"].push_back({{"topic", picture.topics[e.topic].name},
                             {"to", picture.processes[e.to].name},
                             {"port", e.port},
                             {"delay_ns", e.delay.count()}});
  }
  return json.dump();
}

namespace {

std::string readers(const Picture& picture, std::size_t topic) {
  std::string text;
  for (const auto& e : picture.edges) {
    if (e.topic != topic) continue;
    const std::string delay = delay_words(e.delay);
    text += fmt::format("{}{}.{}{}", text.empty() ? "" : ", ", picture.processes[e.to].name, e.port,
                        delay.empty() ? "" : " (" + delay + ")");
  }
  return text.empty() ? "nobody" : text;
}

std::string inputs(const Picture& picture, std::size_t process) {
  std::string text;
  for (const auto& e : picture.edges) {
    if (e.to != process) continue;
    const std::string delay = delay_words(e.delay);
    text +=
        fmt::format("  reads {} as {}{}\n", picture.topics[e.topic].name, e.port, delay.empty() ? "" : ", " + delay);
  }
  return text;
}

}  // namespace

std::string to_text(const Picture& picture) {
  std::size_t name_width = 0;
  std::size_t type_width = 0;
  for (const auto& t : picture.topics) {
    name_width = std::max(name_width, t.name.size());
    type_width = std::max(type_width, t.type.size());
  }
  std::string text;
  for (std::size_t p = 0; p < picture.processes.size(); ++p) {
    const auto& process = picture.processes[p];
    text += process.name + (process.component.empty() ? "" : " (" + process.component + ")") +
            (process.ports_known ? "\n" : ": its ports are not known before it runs\n");
    text += inputs(picture, p);
    for (std::size_t t = 0; t < picture.topics.size(); ++t) {
      const auto& topic = picture.topics[t];
      if (topic.publisher != p) continue;
      text += fmt::format("  {:<{}}  {:<{}}  {:>7}  {:>7}  -> {}\n", topic.name, name_width, topic.type, type_width,
                          rate_words(topic.rate), size_words(topic.max_bytes), readers(picture, t));
    }
  }
  return text;
}

namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

/// What a topic is called on its arrow: the publisher stands at its tail already.
std::string arrow_words(const Picture& picture, const Picture::Topic& topic) {
  const std::string prefix = picture.processes[topic.publisher].name + "/";
  std::string text = topic.name.starts_with(prefix) ? topic.name.substr(prefix.size()) : topic.name;
  if (const std::string rate = rate_words(topic.rate); !rate.empty()) text += "  " + rate;
  if (topic.max_bytes >= 1'000'000) text += "  " + size_words(topic.max_bytes);  // what fills the bus
  return text;
}

}  // namespace

std::string to_dot(const Picture& picture) {
  std::string dot =
      "digraph ensonify {\n"
      "  rankdir=LR;\n"
      "  node [shape=box, style=\"rounded,filled\", fillcolor=\"#e8f1fa\", color=\"#33658a\", "
      "fontname=\"Helvetica\"];\n"
      "  edge [color=\"#33658a\", fontname=\"Helvetica\", fontsize=9];\n";
  for (const auto& p : picture.processes) {
    const std::string component = p.component.empty() || p.component == p.name ? "" : "\\n" + p.component;
    std::string label = quoted(p.name);
    label.insert(label.size() - 1, component);
    dot +=
        fmt::format("  {} [label={}{}];\n", quoted(p.name), label, p.ports_known ? "" : ", style=\"rounded,dashed\"");
  }
  // One arrow per pair of processes and delay, with all its topics.
  std::map<std::tuple<std::size_t, std::size_t, SimTime>, std::string> arrows;
  for (const auto& e : picture.edges) {
    const auto& topic = picture.topics[e.topic];
    std::string& label = arrows[{topic.publisher, e.to, e.delay}];
    label += (label.empty() ? "" : "\\n") + arrow_words(picture, topic);
  }
  for (const auto& [ends, topics] : arrows) {
    const auto& [from, to, delay] = ends;
    const std::string words = delay_words(delay);
    dot += fmt::format("  {} -> {} [label=\"{}{}\"{}];\n", quoted(picture.processes[from].name),
                       quoted(picture.processes[to].name), topics, words.empty() ? "" : "\\n" + words,
                       words.empty() ? "" : ", style=dashed");
  }
  return dot + "}\n";
}

}  // namespace ensonify::graph_tool
