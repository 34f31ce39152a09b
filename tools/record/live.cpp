#include "tools/record/live.h"

#include <poll.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>

#include "components/errors/exit_error.h"
#include "components/record/writer.h"
#include "components/runtime/bus/observer.h"
#include "components/runtime/clock_client.h"
#include "components/runtime/ports.h"
#include "components/runtime/tool.h"
#include "messages/schema.h"
#include "scenarios/scenario_file.h"

namespace ensonify::record_tool {

namespace {

using nlohmann::json;
using std::chrono::steady_clock;

constexpr int kQueue = 100;                           // messages per publisher
constexpr std::size_t kHoldBytes = 512U << 20U;       // then the oldest is written, whatever may still come
constexpr std::chrono::milliseconds kLookAfter{200};  // for Ctrl-C

/// The topics asked for, by id; those for viewers alone stand behind the others and are in no record.
std::map<std::uint16_t, TopicEntry> chosen(const RunRegistry& registry, const std::vector<std::string>& wanted) {
  std::map<std::uint16_t, TopicEntry> topics;
  std::vector<bool> used(wanted.size());
  for (std::size_t id = 0; id < registry.topics.size(); ++id) {
    const TopicEntry& topic = registry.topics[id];
    bool take = wanted.empty();
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (!topic_matches(wanted[i], topic.name)) continue;
      used[i] = take = true;
    }
    if (take && !topic.live_only) topics.emplace(static_cast<std::uint16_t>(id), topic);
  }
  const auto unused = std::find(used.begin(), used.end(), false);
  if (unused != used.end())
    throw UserError(wanted[static_cast<std::size_t>(unused - used.begin())] +
                    ": names no topic of this run; `ensonify topic list` shows them");
  return topics;
}

std::map<std::string, std::string> facts_of(ClockClient& clock) {
  std::map<std::string, std::string> facts;
  const json names = clock.ask({{"kind", "get"}});
  for (const json& name : names.at("facts"))
    facts[name.get<std::string>()] = clock.ask({{"kind", "get"}, {"what", name}}).at("text").get<std::string>();
  return facts;
}

record::RecordInfo info_of(const std::map<std::string, std::string>& facts) {
  record::RecordInfo info{facts.at("version"), 0, parse_utc_ns(facts.at("start_utc")).value_or(0)};
  const std::string& seed = facts.at("seed");
  std::from_chars(seed.data(), seed.data() + seed.size(), info.seed);
  return info;
}

std::uint32_t rank_of(const RunRegistry& registry, const std::string& publisher) {
  const auto found = std::find_if(registry.processes.begin(), registry.processes.end(),
                                  [&](const RunRegistry::Process& process) { return process.name == publisher; });
  return static_cast<std::uint32_t>(found - registry.processes.begin());
}

/// Before all have joined there is no wiring: nothing is published either.
void await_start(ClockClient& clock, std::optional<steady_clock::time_point> until) {
  while (clock.ask({{"kind", "status"}}).at("state") == "connecting" && !interrupted() &&
         (!until || steady_clock::now() < *until))
    ::poll(nullptr, 0, 20);
}

}  // namespace

LiveRecord record_live(const LiveOptions& options) {
  std::optional<steady_clock::time_point> until;
  if (options.timeout_s > 0.0)
    until = steady_clock::now() +
            std::chrono::duration_cast<steady_clock::duration>(std::chrono::duration<double>(options.timeout_s));
  ClockClient clock(options.run);
  await_start(clock, until);
  const RunRegistry registry = clock.registry();
  const auto topics = chosen(registry, options.topics);
  std::vector<bus::Observer::Topic> watched;
  for (const auto& [id, topic] : topics) watched.push_back({topic.name, topic.endpoint});
  bus::Observer observer(watched, clock.keys(), kQueue);  // from here on nothing waits for the facts

  const auto facts = facts_of(clock);
  record::RecordWriter writer(options.file, info_of(facts), record::attachments_of(facts));
  for (const auto& [id, topic] : topics) {
    writer.add_channel({id, topic.name, topic.type, msg::json_schema(msg::find_type(topic.type)),
                        rank_of(registry, topic.publisher), topic.max_bytes});
  }
  const auto keep = [&](const msg::Packet& packet) {
    const msg::Envelope& envelope = packet.envelope;
    writer.write(static_cast<std::uint16_t>(envelope.topic_id), envelope.seq, SimTime{envelope.t_sim_ns},
                 msg::encode_inline(packet.body));
  };
  LiveOrder order(keep, kLongestWindow, kHoldBytes);
  LiveRecord result;
  std::optional<std::uint32_t> epoch;
  while (!interrupted() && !result.run_ended && !result.reset && (!until || steady_clock::now() < *until)) {
    const auto soon = steady_clock::now() + kLookAfter;
    auto packet = observer.next(until ? std::min(soon, *until) : soon);
    if (packet && topics.contains(static_cast<std::uint16_t>(packet->envelope.topic_id))) {
      if (!epoch) epoch = packet->envelope.epoch;
      if (packet->envelope.epoch == *epoch) order.take(std::move(*packet));
      result.reset = packet->envelope.epoch > *epoch;
    } else {
      result.run_ended = observer.ended();
    }
  }
  order.finish();

  record::TextMap map;
  for (const auto& [id, topic] : topics) {
    const auto kept = order.kept().find(topic.name);
    const Kept& count = result.topics[topic.name] = kept == order.kept().end() ? Kept{} : kept->second;
    map.emplace_back(topic.name + "/received", std::to_string(count.received));
    map.emplace_back(topic.name + "/missed", std::to_string(count.missed));
  }
  writer.close_with(record::kLiveName, map);
  return result;
}

}  // namespace ensonify::record_tool
