#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "messages/codec.h"
#include "messages/console.h"
#include "tools/console/scalars.h"

namespace ensonify::console {

/// Numbers over sim time, named TOPIC.field, from when somebody first asked for them. Viewers fetch what is new to
/// them.
///
/// Ten minutes are kept. Ten points a second are kept as they are; of more, the least and the greatest of every 0.2 s.
/// A silence that is long for the topic becomes a point without a value, and so does a message that was lost.
class Values {
 public:
  static constexpr double kKept_s = 600.0;
  static constexpr double kSlot_s = 0.2;
  static constexpr std::size_t kMostSeries = 64;
  static constexpr std::size_t kMostPoints = 4000;  // in one message

  /// All that viewers ask for from now on, and the types of the topics there are.
  void want(const std::set<std::string>& names, const std::map<std::string, std::string>& types);
  /// Topics that are needed for that.
  std::set<std::string> topics() const;
  void take(const std::string& type, const msg::Packet& packet);
  /// Begins anew: viewers drop what they have.
  void clear();

  /// How far a viewer has come.
  struct Seen {
    std::int64_t generation = 0;
    std::map<std::string, std::int64_t> points;
  };
  /// What is new of these names since then; nothing when nothing is.
  std::optional<msg::ConsoleValues> news(const std::vector<std::string>& names, Seen& seen) const;

 private:
  struct Point {
    double time_s = 0.0;
    double value = 0.0;
  };
  struct Series {
    std::string topic;
    std::string field;
    std::string unit;
    bool wanted = true;
    LastPing last_ping;
    std::optional<std::uint64_t> seq;  // of the newest message
    std::optional<double> newest_s;
    double usual_s = 0.0;  // time between messages, smoothed
    std::int64_t slot = INT64_MIN;
    std::vector<Point> in_slot;
    std::deque<Point> points;
    std::int64_t first = 0;  // index of the oldest point
  };

  void add(Series& series, std::uint64_t seq, Point point);
  static void close_slot(Series& series);

  std::int64_t generation_ = 1;
  std::map<std::string, Series> series_;
  std::optional<std::uint32_t> epoch_;
};

}  // namespace ensonify::console
