#include <fmt/format.h>

#include <map>
#include <string>
#include <tuple>

#include "tools/graph/picture_text.h"
#include "tools/graph/words.h"

namespace ensonify::graph_tool {
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
