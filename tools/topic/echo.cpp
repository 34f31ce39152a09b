// Messages as they come.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "components/errors/exit_error.h"
#include "components/errors/nearest_name.h"
#include "components/runtime/tool.h"
#include "messages/schema.h"
#include "tools/topic/observe.h"
#include "tools/topic/pretty.h"
#include "tools/topic/select.h"

namespace ensonify::topic_tool {
namespace {

UserError no_such_field(const std::string& type, const std::string& field, const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(field, known);
  const std::string hint =
      nearest.empty() ? fmt::format("there are {}", fmt::join(known, ", ")) : fmt::format("did you mean {}?", nearest);
  return UserError(fmt::format("--field {}: {} has no such field; {}", field, type, hint));
}

/// A field that a known type does not have is a mistake before anything has come.
void check_field(const TopicEntry& topic, const std::string& field) {
  const msg::TypeInfo* type = msg::find_type(topic.type);
  if (field.empty() || type == nullptr || find_field(type, field) != nullptr) return;
  std::vector<std::string> known;
  for (const auto& info : type->fields) known.push_back(info.name);
  throw no_such_field(topic.type, field, known);
}

const msg::Value& chosen(const msg::Value& message, const TopicEntry& topic, const std::string& field) {
  const msg::Value* value = message.at(field);
  if (value != nullptr) return *value;
  std::vector<std::string> known;
  if (const auto* map = message.as<msg::Value::Map>()) {
    for (const auto& entry : *map) known.push_back(entry.first);
  }
  throw no_such_field(topic.type, field, known);
}

void print_json(const msg::Packet& packet, const TopicEntry& topic, const msg::Value& content, const Options& options) {
  constexpr std::size_t kFew = 16;
  const std::size_t elements = options.full ? SIZE_MAX : kFew;
  const msg::Value& shown = chosen(content, topic, options.field);
  fmt::print(R"({{"topic":{},"type":{},"seq":{},"t_sim_ns":{},"{}":{}{}}})"
             "\n",
             nlohmann::json(topic.name).dump(), nlohmann::json(topic.type).dump(), packet.envelope.seq,
             packet.envelope.t_sim_ns, options.field.empty() ? "content" : "value", msg::to_json(shown, elements),
             packet.wall_facts.size > 0 ? fmt::format(R"(,"wall_facts":{})", packet.wall_facts.text()) : "");
}

void print_text(const msg::Packet& packet, const TopicEntry& topic, const msg::Value& content, const Options& options) {
  const msg::TypeInfo* type = msg::find_type(topic.type);
  const double t_s = 1e-9 * static_cast<double>(packet.envelope.t_sim_ns);
  if (options.field.empty()) {
    fmt::print("t={:.3f} s {} {} seq={}\n{}", t_s, topic.name, topic.type, packet.envelope.seq,
               message_text(content, type));
    if (packet.wall_facts.size > 0) fmt::print("  wall facts: {}\n", packet.wall_facts.text());
    return;
  }
  const msg::FieldInfo* info = find_field(type, options.field);
  fmt::print("t={:.3f} s {}\n", t_s,
             value_text(chosen(content, topic, options.field), info != nullptr ? info->unit : ""));
}

}  // namespace

int echo(const Options& options) {
  std::map<std::string, TopicEntry> topics;
  ClockClient clock(options.run);
  const auto selected = select(clock.registry(), options.topics);
  for (const TopicEntry& topic : selected) {
    check_field(topic, options.field);
    topics[topic.name] = topic;
  }
  bus::Observer observer = observe(clock, selected);
  const auto until = deadline(options);
  std::uint64_t shown = 0;
  while (options.count == 0 || shown < options.count) {
    const auto packet = observer.next(until);
    if (interrupted()) return kExitInterrupted;
    if (!packet) break;
    const auto topic = topics.find(packet->topic);
    if (topic == topics.end()) continue;
    const msg::Value content = msg::decode_value(packet->body, topic->second.max_bytes);
    (options.json ? print_json : print_text)(*packet, topic->second, content, options);
    if (std::fflush(stdout) != 0) throw DataLost("standard output cannot be written");
    ++shown;
  }
  if (shown >= options.count) return kExitOk;
  fmt::print(stderr, "ensonify topic: {} of {} messages came {}\n", shown, options.count,
             observer.ended() ? "before the run ended" : fmt::format("within {:g} s", options.timeout_s));
  return kExitAssertionFailed;
}

}  // namespace ensonify::topic_tool
