#include "tools/console/alarms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "messages/clock.h"
#include "messages/health.h"
#include "messages/motion.h"
#include "messages/sonar.h"
#include "messages/soundings.h"

namespace ensonify::console {

namespace {

constexpr std::string_view kLatePings[] = {"pings_skipped", "triggers_missed", "triggers_late", "late_ping"};

// Where a cause is over, as a share of its limit.
constexpr double kOnLineAgain = 0.8;
constexpr double kInTimeAgain = 0.5;
constexpr double kGigabyte = 1e9;

std::string process_of(const std::string& topic) { return topic.substr(0, topic.find('/')); }

template <msg::Message M>
M decoded(const msg::Packet& packet) {
  return msg::decode<M>(packet.body, packet.body.size());
}

bool has_bottom(const msg::Soundings& soundings) {
  const auto valid = soundings.valid.flat();
  return std::find(valid.begin(), valid.end(), 1) != valid.end();
}

}  // namespace

bool Alarms::needs(const std::string& type) {
  return type == msg::Soundings::kType || type == msg::BottomTrack::kType || type == msg::Health::kType ||
         type == msg::ClockHealth::kType || type == msg::MissionState::kType;
}

void Alarms::take(const std::string& type, const msg::Packet& packet) {
  now_ns_ = std::max(now_ns_, packet.envelope.t_sim_ns);
  count_lost(packet);
  if (type == msg::Soundings::kType) bottom(packet.topic, has_bottom(decoded<msg::Soundings>(packet)));
  else if (type == msg::BottomTrack::kType) bottom(packet.topic, decoded<msg::BottomTrack>(packet).valid);
  else if (type == msg::Health::kType) health(packet);
  else if (type == msg::ClockHealth::kType) clock(packet);
  else if (type == msg::MissionState::kType) mission(packet);
}

void Alarms::keep(const std::set<std::string>& topics) {
  std::erase_if(seq_, [&](const auto& entry) { return !topics.contains(entry.first); });
}

void Alarms::count_lost(const msg::Packet& packet) {
  const auto before = seq_.find(packet.topic);
  const std::uint64_t seq = packet.envelope.seq;
  if (before != seq_.end() && seq > before->second + 1) {
    std::int64_t& lost = lost_[packet.topic];
    lost += static_cast<std::int64_t>(seq - before->second - 1);
    happened("lost", packet.topic, fmt::format("{} messages did not reach this console", lost));
  }
  seq_[packet.topic] = seq;
}

void Alarms::bottom(const std::string& topic, bool found) {
  int& without = without_bottom_[topic];
  if (found) {
    without = 0;
    lower("no_bottom", topic);
  } else if (++without >= limits_.pings_without_bottom) {
    raise("no_bottom", topic, fmt::format("no bottom in the last {} pings", without));
  }
}

void Alarms::health(const msg::Packet& packet) {
  const auto health = decoded<msg::Health>(packet);
  const std::string process = process_of(packet.topic);
  for (const char* state : {"degraded", "failed"}) {
    if (health.state == state) raise(state, process, health.message.empty() ? "no reason is given" : health.message);
    else lower(state, process);
  }
  std::int64_t count = 0;
  for (const msg::Counter& counter : health.counters)
    if (std::find(std::begin(kLatePings), std::end(kLatePings), counter.name) != std::end(kLatePings))
      count += counter.count;
  std::int64_t& known = late_pings_[process];
  if (count > known) happened("late_pings", process, fmt::format("{} pings were late or left out", count));
  known = count;
}

void Alarms::clock(const msg::Packet& packet) {
  const auto clock = decoded<msg::ClockHealth>(packet);
  const std::string process = process_of(packet.topic);
  if (clock.rate > 0.0 && clock.lateness_s > limits_.late_s)
    raise("late", process, fmt::format("the run stands {:.1f} s behind its pace", clock.lateness_s));
  else if (clock.lateness_s < kInTimeAgain * limits_.late_s) lower("late", process);
  if (clock.slips > slips_.value_or(clock.slips))
    happened("slips", process, fmt::format("{} slips, {:.1f} s of lost time given up", clock.slips, clock.slip_s));
  slips_ = clock.slips;
  for (const msg::Pace& pace : clock.participants) {
    double& worst_s = worst_lateness_s_[pace.name];
    if (clock.rate > 0.0 && pace.worst_lateness_s > std::max(worst_s, limits_.waited_s))
      happened("late", pace.name,
               fmt::format("the run waited for it, by up to {:.2f} s; {} late events so far", pace.worst_lateness_s,
                           pace.late_events));
    worst_s = std::max(worst_s, pace.worst_lateness_s);
  }
}

void Alarms::mission(const msg::Packet& packet) {
  const auto mission = decoded<msg::MissionState>(packet);
  const double off_m = std::abs(mission.cross_track_m);
  if (mission.state == "on_line" && off_m > limits_.off_line_m)
    raise("off_line", packet.topic,
          fmt::format("{:.1f} m to {} of the runline", off_m, mission.cross_track_m > 0.0 ? "starboard" : "port"));
  else if (mission.state != "on_line" || off_m < kOnLineAgain * limits_.off_line_m) lower("off_line", packet.topic);
}

void Alarms::disk(const std::string& folder, std::uintmax_t free_bytes) {
  if (static_cast<double>(free_bytes) < kGigabyte * limits_.disk_gb)
    raise("disk", folder, fmt::format("{} MB left", free_bytes / 1'000'000));
  else lower("disk", folder);
}

/// Null when there is no room; what has passed makes room.
msg::ConsoleAlarm* Alarms::entry(const Key& key) {
  if (const auto known = alarms_.find(key); known != alarms_.end()) return &known->second;
  if (alarms_.size() >= kMostAlarms) {
    const auto passed = std::find_if(alarms_.begin(), alarms_.end(), [](const auto& a) { return !a.second.active; });
    if (passed == alarms_.end()) return nullptr;
    alarms_.erase(passed);
  }
  msg::ConsoleAlarm& fresh = alarms_[key];
  fresh.kind = key.first;
  fresh.source = key.second;
  return &fresh;
}

void Alarms::raise(const std::string& kind, const std::string& source, const std::string& text) {
  msg::ConsoleAlarm* alarm = entry({kind, source});
  if (alarm == nullptr || (alarm->active && alarm->text == text)) return;
  changed_ = true;
  alarm->text = text;
  if (alarm->active) return;
  alarm->active = true;
  alarm->since_ns = now_ns_;
  ++alarm->raised;
}

void Alarms::lower(const std::string& kind, const std::string& source) {
  const auto known = alarms_.find({kind, source});
  if (known == alarms_.end() || !known->second.active) return;
  known->second.active = false;
  changed_ = true;
}

void Alarms::happened(const std::string& kind, const std::string& source, const std::string& text) {
  msg::ConsoleAlarm* alarm = entry({kind, source});
  if (alarm == nullptr) return;
  alarm->text = text;
  alarm->since_ns = now_ns_;
  ++alarm->raised;
  changed_ = true;
}

void Alarms::clear() {
  const std::int64_t next = generation_ + 1;
  *this = Alarms(limits_);
  generation_ = next;
  changed_ = true;
}

bool Alarms::changed() { return std::exchange(changed_, false); }

msg::ConsoleAlarms Alarms::message() const {
  msg::ConsoleAlarms message{generation_, {}};
  for (const auto& [key, alarm] : alarms_) message.alarms.push_back(alarm);
  return message;
}

}  // namespace ensonify::console
