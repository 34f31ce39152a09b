// ensonify topic: examines the topics of a live run, on the live plane only. list and info say what the registry and
// the schemas hold, echo prints messages, hz and bw measure how often and how much they come.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "components/config/config_error.h"
#include "components/errors/exit_error.h"
#include "components/errors/nearest_name.h"
#include "components/runtime/bus/observer.h"
#include "components/runtime/clock_client.h"
#include "components/runtime/tool.h"
#include "messages/schema.h"
#include "tools/topic/meter.h"
#include "tools/topic/pretty.h"
#include "tools/topic/publish.h"

namespace ensonify::topic_tool {
namespace {

/// Options of the user; each verb uses its own.
struct Options {
  std::string run;
  bool json = false;
  std::vector<std::string> topics;  // names or patterns
  std::uint64_t count = 0;          // leave after so many messages; 0: never
  double timeout_s = 0.0;           // leave after so long, wall time; 0: never
  std::string field;                // echo: only this one
  bool full = false;                // echo --json: every element of every array
  std::uint64_t window = 1000;      // hz, bw: messages that the rates are taken over
  Publication publication;          // pub
};

/// Time to leave, or nothing for never.
std::optional<bus::Observer::WallTime> deadline(const Options& options) {
  using Clock = std::chrono::steady_clock;
  if (options.timeout_s <= 0.0) return std::nullopt;
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.timeout_s));
}

/// Subscribes to the live plane of these topics.
bus::Observer observe(const ClockClient& clock, const std::vector<TopicEntry>& topics) {
  std::vector<bus::Observer::Topic> watched;
  for (const TopicEntry& topic : topics) watched.push_back({topic.name, topic.endpoint});
  return bus::Observer(watched, clock.keys());
}

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

using std::chrono::steady_clock;

enum class What { kRate, kBandwidth };
using Meters = std::map<std::string, Meter>;

void print_head(What what, std::size_t width) {
  if (what == What::kRate) {
    fmt::print("{:<{}} {:>9} {:>9} {:>14} {:>12} {:>15} {:>9} {:>8}\n", "topic", width, "sim Hz", "wall Hz",
               "interval (ms)", "jitter (ms)", "sim jitter (ms)", "received", "dropped");
  } else {
    fmt::print("{:<{}} {:>12} {:>14} {:>10} {:>10} {:>10} {:>9} {:>8}\n", "topic", width, "per wall s", "per sim s",
               "mean", "smallest", "largest", "received", "dropped");
  }
}

void print_row(What what, const std::string& topic, std::size_t width, const Traffic& t) {
  if (what == What::kRate) {
    fmt::print("{:<{}} {:>9.3f} {:>9.3f} {:>14.3f} {:>12.3f} {:>15.3f} {:>9} {:>8}\n", topic, width, t.sim_hz,
               t.wall_hz, 1e3 * t.wall.mean_s, 1e3 * t.wall.jitter_s, 1e3 * t.sim.jitter_s, t.received, t.dropped);
  } else {
    fmt::print("{:<{}} {:>12} {:>14} {:>10} {:>10} {:>10} {:>9} {:>8}\n", topic, width, bytes_text(t.wall_bytes_per_s),
               bytes_text(t.sim_bytes_per_s), bytes_text(t.mean_bytes), bytes_text(static_cast<double>(t.min_bytes)),
               bytes_text(static_cast<double>(t.max_bytes)), t.received, t.dropped);
  }
}

nlohmann::ordered_json to_json(const std::string& topic, const Traffic& t) {
  return {{"topic", topic},
          {"received", t.received},
          {"dropped", t.dropped},
          {"sim_hz", t.sim_hz},
          {"wall_hz", t.wall_hz},
          {"wall_interval_s", t.wall.mean_s},
          {"wall_jitter_s", t.wall.jitter_s},
          {"sim_interval_s", t.sim.mean_s},
          {"sim_jitter_s", t.sim.jitter_s},
          {"wall_bytes_per_s", t.wall_bytes_per_s},
          {"sim_bytes_per_s", t.sim_bytes_per_s},
          {"mean_bytes", t.mean_bytes},
          {"min_bytes", t.min_bytes},
          {"max_bytes", t.max_bytes}};
}

class Reporter {
 public:
  Reporter(What what, bool json, const Meters& meters) : what_(what), json_(json), meters_(meters) {
    for (const auto& [topic, meter] : meters) width_ = std::max(width_, topic.size());
  }

  /// Rows of the topics that have come so far.
  void report() {
    if (json_) return;
    for (const auto& [topic, meter] : meters_) {
      const Traffic t = meter.traffic();
      if (t.received == 0) continue;
      if (!headed_) print_head(what_, width_);
      headed_ = true;
      print_row(what_, topic, width_, t);
    }
    if (std::fflush(stdout) != 0) throw DataLost("standard output cannot be written");
  }

  /// 0 if a rate can be reported of at least one topic.
  int finish() {
    report();
    std::string silent;
    std::size_t measured = 0;
    auto all = nlohmann::ordered_json::array();
    for (const auto& [topic, meter] : meters_) {
      const Traffic t = meter.traffic();
      all.push_back(to_json(topic, t));
      if (t.received >= 2) ++measured;
      else silent += " " + topic;
    }
    if (json_) fmt::print("{}\n", all.dump());
    if (!silent.empty()) fmt::print(stderr, "ensonify topic: fewer than two messages came on{}\n", silent);
    return measured > 0 ? kExitOk : kExitAssertionFailed;
  }

 private:
  What what_;
  bool json_;
  const Meters& meters_;
  std::size_t width_ = 5;
  bool headed_ = false;
};

int measure(What what, const Options& options) {
  constexpr std::chrono::seconds kReportEvery{1};
  ClockClient clock(options.run);
  const auto selected = select(clock.registry(), options.topics);
  Meters meters;
  for (const TopicEntry& topic : selected) meters.emplace(topic.name, Meter(options.window));
  Reporter reporter(what, options.json, meters);
  bus::Observer observer = observe(clock, selected);
  const auto until = deadline(options);
  auto report_at = steady_clock::now() + kReportEvery;
  std::uint64_t received = 0;
  while (options.count == 0 || received < options.count) {
    const auto packet = observer.next(until ? std::min(*until, report_at) : report_at);
    const auto now = steady_clock::now();
    if (packet) {
      const auto meter = meters.find(packet->topic);
      if (meter == meters.end()) continue;
      meter->second.add(now, SimTime{packet->envelope.t_sim_ns}, packet->envelope.seq, packet->body.size());
      ++received;
    } else if (interrupted() || observer.ended() || (until && now >= *until)) {
      break;
    }
    if (now >= report_at) {
      reporter.report();
      report_at = now + kReportEvery;
    }
  }
  return reporter.finish();
}

int hz(const Options& options) { return measure(What::kRate, options); }
int bw(const Options& options) { return measure(What::kBandwidth, options); }

CLI::App* verb(CLI::App& app, Options& options, const std::string& name, const std::string& about) {
  CLI::App* sub = app.add_subcommand(name, about);
  add_run_option(*sub, options.run);
  sub->add_flag("--json", options.json, "JSON for scripts; times in ns or s, sizes in bytes, as the keys say");
  sub->add_option("TOPIC", options.topics, "topics, or patterns such as 'bow/*'");
  return sub;
}

CLI::App* listener(CLI::App& app, Options& options, const std::string& name, const std::string& about) {
  CLI::App* sub = verb(app, options, name, about);
  sub->get_option("TOPIC")->required();
  sub->add_option("--count,-n", options.count, "leave after so many messages in all (default: at the end of the run)");
  sub->add_option("--timeout", options.timeout_s, "leave after so long, wall s (default: at the end of the run)")
      ->check(CLI::Range(1e-3, 1e6));
  return sub;
}

void add_verbs(CLI::App& app, Options& options) {
  verb(app, options, "list", "every topic with type, declared rate and size, messages so far, subscribers");
  verb(app, options, "info", "one topic in full, with its fields and their units")->get_option("TOPIC")->required();
  CLI::App* echo = listener(app, options, "echo", "prints messages, arrays abbreviated");
  echo->add_option("--field", options.field, "only this field, e.g. range_m or position_enu_m.2");
  echo->add_flag("--full", options.full, "with --json: every element of every array");
  for (const auto& [name, about] : {std::pair{"hz", "how often: Hz in sim time and wall time, and the jitter of both"},
                                    {"bw", "how much: bytes per second of wall time and of sim time"}}) {
    listener(app, options, name, about)
        ->add_option("--window", options.window, "messages per topic that the rates are taken over")
        ->check(CLI::Range(2, 1'000'000))
        ->capture_default_str();
  }
}

void add_pub(CLI::App& app, Publication& publication) {
  CLI::App* pub = app.add_subcommand(
      "pub",
      "publishes a message again and again, as a participant that the launch file declares `external: true`\n"
      "and that has not joined. The run waits for it like for any participant, and it stays until the run ends: "
      "Ctrl-C\n"
      "ends both. Example: ensonify topic pub agent/command guidance/1 speed_mps=1.5 heading_grid_rad=0.3");
  add_run_option(*pub, publication.run);
  pub->add_option("TOPIC", publication.topic, "PROCESS/PORT, such as agent/command")->required();
  pub->add_option("TYPE", publication.type, "type of the message, such as guidance/1 (`ensonify describe --reference`)")
      ->required();
  pub->add_option("FIELD", publication.fields, "FIELD=VALUE, values as in YAML; other fields keep their defaults");
  pub->add_option("--rate", publication.rate_hz, "messages per second of sim time")
      ->check(CLI::Range(1e-3, 1e3))
      ->capture_default_str();
  pub->add_option("--count,-n", publication.count, "publish so many (default: until the run ends)")
      ->check(CLI::PositiveNumber);
}

int run(const CLI::App& app, const Options& options) {
  const std::string name = app.get_subcommands().front()->get_name();
  if (name == "list") return list(options);
  if (name == "info") return info(options);
  if (name == "echo") return echo(options);
  if (name == "pub") return publish(options.publication);
  return name == "hz" ? hz(options) : bw(options);
}

}  // namespace
}  // namespace ensonify::topic_tool

int main(int argc, char** argv) {
  using namespace ensonify::topic_tool;
  CLI::App app(
      "Shows the topics of a live run, or publishes on one. What is shown can never slow the run: a slow reader loses\n"
      "messages instead, and is shown how many. Nothing is kept for a late one either: it sees what is published from\n"
      "then on; what was said before, such as a chart, only a record holds. Facts fixed for the run (launch, "
      "scenario,\n"
      "...) can be had at any time from `ensonify clock get`. The topic clock/health reports about once a second of "
      "wall\n"
      "time how the run keeps its pace.\n"
      "Exit code: 0 done, 1 fewer messages came than were asked for, 2 no such run, topic or field.",
      "ensonify topic");
  Options options;
  app.require_subcommand(1);
  add_verbs(app, options);
  add_pub(app, options.publication);
  return ensonify::tool_main(app, argc, argv, [&] { return run(app, options); });
}
