#include <fmt/format.h>

#include <algorithm>

#include "tools/graph/picture.h"
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

}  // namespace ensonify::graph_tool
