#include "tools/graph/picture_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/graph/words.h"

namespace ensonify::graph_tool {
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

}  // namespace ensonify::graph_tool
