// What the registry and the schemas hold: `list` and `info`.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "components/errors/exit_error.h"
#include "components/runtime/clock_client.h"
#include "messages/schema.h"
#include "tools/topic/pretty.h"
#include "tools/topic/select.h"
#include "tools/topic/verbs.h"

namespace ensonify::topic_tool {
namespace {

using nlohmann::ordered_json;

std::string subscriber_text(const TopicEntry::Subscriber& s) {
  const std::string name = s.process + "." + s.port;
  return s.delay > SimTime{0} ? fmt::format("{} (delayed {:g} ms)", name, 1e3 * seconds(s.delay)) : name;
}

std::string subscribers_text(const TopicEntry& topic) {
  std::string text;
  for (const auto& s : topic.subscribers) text += (text.empty() ? "" : ", ") + subscriber_text(s);
  return text.empty() ? "nobody" : text;
}

ordered_json to_json(const TopicEntry& topic) {
  ordered_json json = {{"topic", topic.name},
                       {"type", topic.type},
                       {"publisher", topic.publisher},
                       {"component", topic.component},
                       {"rate_hz", topic.rate.num > 0 ? ordered_json(topic.rate.hz()) : ordered_json(nullptr)},
                       {"max_bytes", topic.max_bytes},
                       {"published", topic.published},
                       {"live", topic.endpoint},
                       {"subscribers", ordered_json::array()}};
  for (const auto& s : topic.subscribers) {
    json["subscribers"].push_back({{"process", s.process}, {"port", s.port}, {"delay_ns", s.delay.count()}});
  }
  return json;
}

void print_fields(const std::vector<msg::FieldInfo>& fields, std::size_t indent) {
  std::size_t width = 0;
  for (const auto& field : fields) width = std::max(width, field.name.size());
  for (const auto& field : fields) {
    const std::string unit = field.unit.empty() || field.unit == "1" ? "" : " [" + field.unit + "]";
    fmt::print("{:{}}{:<{}}  {}{}: {}\n", "", indent, field.name, width, msg::type_in_words(field), unit, field.about);
  }
}

void print_info(const TopicEntry& topic) {
  fmt::print(
      "{}\n  type         {}\n  publisher    {} ({})\n  rate         {}\n  at most      {}\n"
      "  published    {} messages\n  subscribers  {}\n  live plane   {}\n",
      topic.name, topic.type, topic.publisher, topic.component, rate_text(topic.rate),
      bytes_text(static_cast<double>(topic.max_bytes)), topic.published, subscribers_text(topic), topic.endpoint);
  if (const msg::TypeInfo* type = msg::find_type(topic.type)) {
    fmt::print("  {}\n", type->about);
    print_fields(type->fields, 4);
  } else {
    fmt::print("  This program does not know the type; `ensonify topic echo {}` shows what comes.\n", topic.name);
  }
}

}  // namespace

int list(const Options& options) {
  const RunRegistry registry = ClockClient(options.run).registry();
  const std::vector<TopicEntry> topics = options.topics.empty() ? registry.topics : select(registry, options.topics);
  if (options.json) {
    ordered_json all = ordered_json::array();
    for (const TopicEntry& topic : topics) all.push_back(to_json(topic));
    fmt::print("{}\n", all.dump());
    return kExitOk;
  }
  std::size_t name_width = 5;
  std::size_t type_width = 4;
  for (const TopicEntry& topic : topics) {
    name_width = std::max(name_width, topic.name.size());
    type_width = std::max(type_width, topic.type.size());
  }
  fmt::print("{:<{}}  {:<{}}  {:>9}  {:>8}  {:>9}  {}\n", "topic", name_width, "type", type_width, "rate", "at most",
             "published", "subscribers");
  for (const TopicEntry& topic : topics) {
    fmt::print("{:<{}}  {:<{}}  {:>9}  {:>8}  {:>9}  {}\n", topic.name, name_width, topic.type, type_width,
               topic.rate.num > 0 ? rate_text(topic.rate) : "", bytes_text(static_cast<double>(topic.max_bytes)),
               topic.published, subscribers_text(topic));
  }
  return kExitOk;
}

int info(const Options& options) {
  const std::vector<TopicEntry> topics = select(ClockClient(options.run).registry(), options.topics);
  if (!options.json) {
    for (const TopicEntry& topic : topics) print_info(topic);
    return kExitOk;
  }
  ordered_json all = ordered_json::array();
  for (const TopicEntry& topic : topics) {
    ordered_json entry = to_json(topic);
    const std::string schema = msg::json_schema(msg::find_type(topic.type));
    entry["schema"] = schema.empty() ? ordered_json(nullptr) : ordered_json::parse(schema);
    all.push_back(entry);
  }
  fmt::print("{}\n", all.dump());
  return kExitOk;
}

}  // namespace ensonify::topic_tool
