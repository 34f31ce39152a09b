// What the clock gives people: stall reports, status, registry, the report of a finished run.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "components/clock/clock.h"
#include "components/errors/exit_error.h"
#include "components/runtime/log.h"

namespace ensonify::clock {

namespace {

using nlohmann::json;
using std::chrono::steady_clock;

/// R running, S sleeping, T stopped, Z dead...; ? when the system does not state. Linux /proc/<pid>/stat, third field.
char process_state(std::int64_t pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  std::getline(stat, text);
  const std::size_t name_end = text.rfind(')');
  return name_end == std::string::npos || name_end + 2 >= text.size() ? '?' : text[name_end + 2];
}

constexpr const char* kHealthTopic = "clock/health";
constexpr std::size_t kHealthBytes = 1 << 16;

double elapsed_s(WallTime from, WallTime to) { return std::chrono::duration<double>(to - from).count(); }

json to_json(const Summary& s) {
  json j = {{"state", s.state},
            {"epoch", s.epoch},
            {"sim_ns", s.reached == kNever ? json(nullptr) : json(s.reached.count())},
            {"end_ns", s.end ? json(s.end->count()) : json(nullptr)},
            {"wall_s", s.wall_s},
            {"rate", s.rate ? json(*s.rate) : json("free")},
            {"slips", s.slips},
            {"slip_s", seconds(s.slipped)},
            {"exit_code", s.exit_code},
            {"culprit", s.culprit},
            {"message", s.message}};
  return j;
}

json to_json(const Account& a) {
  json j = {{"name", a.name},
            {"pid", a.pid},
            {"grants", a.grants},
            {"cost_s", static_cast<double>(a.cost_ns) * 1e-9},
            {"late_events", a.late_events},
            {"worst_lateness_s", seconds(a.worst_lateness)}};
  if (a.exit_code != 0) j["exit_code"] = a.exit_code;
  if (!a.lost.empty()) j["lost"] = {{"why", a.lost}, {"at_ns", a.lost_at.count()}};
  return j;
}

/// Registry entry of a port for viewers. How much it has published is known to none but its process.
json live_topic(const protocol::Hello& hello, const LivePort& port) {
  return {{"topic", hello.declaration.process + "/" + port.port},
          {"topic_id", kNoTopicId},
          {"type", port.type},
          {"publisher", hello.declaration.process},
          {"component", hello.declaration.component},
          {"max_bytes", port.max_bytes},
          {"rate", {0, 1}},
          {"live", hello.live_endpoint},
          {"sync", ""},
          {"published", 0},
          {"subscribers", json::array()}};
}

}  // namespace

/// Of a process on another host nothing is known: its number may be anybody's here. Of one in this program it says
/// nothing that the clock's own is running.
char Clock::state_of(std::size_t p) const {
  if (epoch_.accounts[p].pid == ::getpid()) return '?';
  const std::string& endpoint = registry_.hellos()[p].sync_endpoint;
  const bool is_here = endpoint.starts_with("ipc://") || endpoint.starts_with("tcp://127.") ||
                       endpoint.starts_with("tcp://" + launch_.clock.address + ":");
  return is_here ? process_state(epoch_.accounts[p].pid) : '?';
}

/// A stopped process first, then a busy one, then whoever has a grant: a participant that blocks on a full queue of a
/// stopped one has a grant too, but is not to blame.
std::vector<std::size_t> Clock::stalled() const {
  for (const char state : {'T', 't', 'R'}) {
    for (std::size_t p = 0; p < epoch_.accounts.size(); ++p) {
      const bool suspect = !is_lost(p) && (state != 'R' || epoch_.conductor->running(p));
      if (suspect && state_of(p) == state) return {p};
    }
  }
  std::vector<std::size_t> ranks;
  for (std::size_t p = 0; p < epoch_.accounts.size(); ++p) {
    if (epoch_.conductor->running(p)) ranks.push_back(p);
  }
  return ranks;
}

std::string Clock::names(const std::vector<std::size_t>& ranks) const {
  std::string names;
  for (const std::size_t p : ranks) names += (names.empty() ? "" : ", ") + epoch_.accounts[p].name;
  return names;
}

void Clock::dump_stall() const {
  for (std::size_t p = 0; p < epoch_.accounts.size(); ++p) {
    std::string waits;
    for (const std::size_t q : epoch_.conductor->waits_for(p))
      waits += (waits.empty() ? "" : ",") + epoch_.accounts[q].name;
    log::line("clock", epoch_.conductor->now(), "stall",
              fmt::format("process={} has_grant={} next_s={:.3f} granted_to_s={:.3f} waits_for=[{}] system_state={}",
                          epoch_.accounts[p].name, epoch_.conductor->running(p), seconds(epoch_.conductor->next(p)),
                          seconds(epoch_.conductor->granted(p)), waits, state_of(p)));
  }
  for (const Graph::Topic& topic : registry_.graph().topics) {
    if (!epoch_.conductor->running(topic.publisher)) continue;
    const auto id = static_cast<std::size_t>(&topic - registry_.graph().topics.data());
    log::line("clock", epoch_.conductor->now(), "stall",
              fmt::format("topic={} published={}", topic.name, epoch_.referee->published(id)));
  }
}

Summary Clock::summary() const {
  Summary s;
  s.epoch = epoch_.number;
  s.rate = pacer_.rate();
  s.slips = epoch_.slips;
  s.slipped = epoch_.slipped;
  s.exit_code = exit_code_;
  s.culprit = culprit_;
  s.message = message_;
  const bool over = epoch_.ended != WallTime{} || phase_ == Phase::kEnding || phase_ == Phase::kOver;
  if (over) s.state = exit_code_ == 0 ? "done" : "failed";
  else if (phase_ == Phase::kRunning) s.state = pacer_.paused() ? "paused" : "running";
  if (epoch_.conductor) {
    s.reached = std::min(epoch_.conductor->now(), epoch_.conductor->end());
    if (epoch_.conductor->end() != kNever) s.end = epoch_.conductor->end();
    if (epoch_.began != WallTime{}) s.wall_s = elapsed_s(epoch_.began, over ? epoch_.ended : steady_clock::now());
  }
  return s;
}

std::string Clock::status_json() const {
  json j = to_json(summary());
  j["kind"] = "status";
  j["participants"] = json::array();
  for (std::size_t p = 0; p < epoch_.accounts.size(); ++p) {
    json entry = to_json(epoch_.accounts[p]);
    std::vector<std::string> waits;
    for (const std::size_t q : epoch_.conductor->waits_for(p)) waits.push_back(epoch_.accounts[q].name);
    const SimTime next = epoch_.conductor->next(p);
    entry["next_ns"] = next == kNever ? json(nullptr) : json(next.count());
    entry["running"] = epoch_.conductor->running(p);
    entry["waiting_on"] = waits;
    j["participants"].push_back(entry);
  }
  if (phase_ == Phase::kJoining) j["missing"] = registry_.missing();
  return j.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string Clock::registry_json() const {
  json topics = json::array();
  const Graph& graph = registry_.graph();
  for (std::size_t t = 0; t < graph.topics.size(); ++t) {
    const Graph::Topic& topic = graph.topics[t];
    json subscribers = json::array();
    for (const Graph::Edge& edge : graph.edges) {
      if (edge.topic == t) {
        subscribers.push_back({{"process", registry_.declarations()[edge.to].process},
                               {"port", registry_.declarations()[edge.to].ins[edge.in_port].port},
                               {"delay_ns", edge.delay.count()}});
      }
    }
    const protocol::Hello& publisher = registry_.hellos()[topic.publisher];
    topics.push_back({{"topic", topic.name},
                      {"topic_id", t},
                      {"type", topic.type},
                      {"publisher", publisher.declaration.process},
                      {"component", publisher.declaration.component},
                      {"max_bytes", topic.max_bytes},
                      {"rate", {topic.rate.num, topic.rate.den}},
                      {"live", publisher.live_endpoint},
                      {"sync", publisher.sync_endpoint},
                      {"published", epoch_.referee ? epoch_.referee->published(t) : 0},
                      {"subscribers", subscribers}});
  }
  if (!graph.topics.empty()) {  // the clock's own, behind everybody's
    topics.push_back({{"topic", kHealthTopic},
                      {"topic_id", graph.topics.size()},
                      {"type", msg::ClockHealth::kType},
                      {"publisher", "clock"},
                      {"component", "clock"},
                      {"max_bytes", kHealthBytes},
                      {"rate", {1, 1}},
                      {"live", control_.live_endpoint()},
                      {"sync", ""},
                      {"published", epoch_.health_count},
                      {"subscribers", json::array()}});
  }
  for (const protocol::Hello& hello : registry_.hellos()) {
    if (graph.topics.empty()) break;
    for (const LivePort& port : hello.declaration.lives) topics.push_back(live_topic(hello, port));
  }
  json processes = json::array();
  for (const Declaration& d : registry_.declarations()) {
    processes.push_back({{"name", d.process}, {"component", d.component}});
  }
  return json{{"kind", "registry"}, {"topics", topics}, {"processes", processes}}.dump(-1, ' ', false,
                                                                                       json::error_handler_t::replace);
}

msg::ClockHealth Clock::health(WallTime now) const {
  const Summary s = summary();
  msg::ClockHealth health;
  health.stamp_ns = s.reached.count();  // while anything runs there is a next event
  health.state = s.state;
  health.wall_s = s.wall_s;
  health.rate = s.rate.value_or(0.0);
  health.rate_factor = seconds(s.reached - epoch_.health_reported_at) / elapsed_s(epoch_.health_reported, now);
  health.lateness_s = seconds(pacer_.lateness(s.reached, now));
  health.slips = static_cast<std::int64_t>(s.slips);
  health.slip_s = seconds(s.slipped);
  for (const Account& account : epoch_.accounts) {
    health.participants.push_back({account.name, static_cast<std::int64_t>(account.grants),
                                   static_cast<double>(account.cost_ns) * 1e-9,
                                   static_cast<std::int64_t>(account.late_events), seconds(account.worst_lateness)});
  }
  return health;
}

/// Published to viewers only. Its topic has no edge: it is in no WELCOME, so no participant can read or record it.
void Clock::report_health(WallTime now) {
  const msg::ClockHealth report = health(now);
  msg::Packet packet;
  packet.topic = kHealthTopic;
  packet.body = msg::encode(report);
  packet.envelope.epoch = epoch_.number;
  packet.envelope.publisher = static_cast<std::uint32_t>(registry_.size());
  packet.envelope.topic_id = static_cast<std::uint32_t>(registry_.graph().topics.size());
  packet.envelope.frame_count = static_cast<std::uint32_t>(msg::kFirstArrayFrame);
  packet.envelope.type_hash = msg::type_hash(msg::ClockHealth::kType);
  packet.envelope.seq = epoch_.health_count++;
  packet.envelope.t_sim_ns = report.stamp_ns;
  control_.publish_live(packet);
  epoch_.health_reported = now;
  epoch_.health_reported_at = SimTime{report.stamp_ns};
}

void Clock::write_report(const std::filesystem::path& folder) const {
  json j = to_json(summary());
  j["sim_s"] = epoch_.conductor ? seconds(summary().reached) : 0.0;
  std::uint64_t late = 0;
  j["participants"] = json::array();
  for (const Account& account : epoch_.accounts) {
    late += account.late_events;
    j["participants"].push_back(to_json(account));
  }
  j["late_events"] = late;
  std::ofstream file(folder / "clock.json");
  file << j.dump(2, ' ', false, json::error_handler_t::replace) << '\n';
}

}  // namespace ensonify::clock
