#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "messages/codec.h"
#include "messages/console.h"

namespace ensonify::console {

/// Beyond which an alarm is raised.
struct AlarmLimits {
  int pings_without_bottom = 5;  // in a row, for an alarm
  double off_line_m = 10.0;      // from the runline, while on it; over at 0.8 of that
  double late_s = 1.0;           // behind paced time; over at half of that
  double waited_s = 0.25;        // for one process, by the lateness that is charged to it
  double disk_gb = 1.0;          // left where results are written, 10^9 bytes
};

/// What an operator has to know of, made of messages that a run publishes anyway. A page keeps an alarm until somebody
/// has acknowledged it there; here is only what was raised, how often, and whether its cause lasts.
class Alarms {
 public:
  static constexpr std::size_t kMostAlarms = 64;

  explicit Alarms(const AlarmLimits& limits = {}) : limits_(limits) {}

  /// Types whose messages it is made of.
  static bool needs(const std::string& type);

  void take(const std::string& type, const msg::Packet& packet);
  /// Topics that have been received without a break since take() saw them last; of others no message is missed.
  void keep(const std::set<std::string>& topics);
  /// Space left where results are written.
  void disk(const std::string& folder, std::uintmax_t free_bytes);
  /// Begins anew.
  void clear();

  /// True once after something has changed.
  bool changed();
  msg::ConsoleAlarms message() const;

 private:
  using Key = std::pair<std::string, std::string>;  // kind, source

  msg::ConsoleAlarm* entry(const Key& key);
  void raise(const std::string& kind, const std::string& source, const std::string& text);
  void lower(const std::string& kind, const std::string& source);
  void happened(const std::string& kind, const std::string& source, const std::string& text);
  void count_lost(const msg::Packet& packet);
  void bottom(const std::string& topic, bool found);
  void health(const msg::Packet& packet);
  void clock(const msg::Packet& packet);
  void mission(const msg::Packet& packet);

  AlarmLimits limits_;
  std::int64_t generation_ = 1;
  std::int64_t now_ns_ = 0;
  bool changed_ = false;
  std::map<Key, msg::ConsoleAlarm> alarms_;
  std::map<std::string, std::uint64_t> seq_;        // of the newest message, by topic
  std::map<std::string, std::int64_t> lost_;        // messages, by topic
  std::map<std::string, int> without_bottom_;       // pings in a row, by topic
  std::map<std::string, std::int64_t> late_pings_;  // by process, as counted there
  std::map<std::string, double> worst_lateness_s_;  // by process
  std::optional<std::int64_t> slips_;
};

}  // namespace ensonify::console
