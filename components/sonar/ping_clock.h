#pragma once

#include <deque>
#include <optional>

#include "components/runtime/ports.h"
#include "components/sonar/ping_timing.h"
#include "messages/sonar.h"

namespace ensonify {

/// Schedule of a head's transmissions. Whatever the trigger, the interval is never less than the reception time plus
/// the dead time, nor than that of the ping rate. Free: on the beat as long as pings fit into it; a ping that receives
/// longer moves the beat. Slave: a transmission of the master that comes too early to be followed is passed over and
/// counted
/// (`triggers_missed`). Interleaved: slots that come too early are passed over; the beat never moves. Times are
/// computed from counts, never summed.
///
/// A slave has the input `trigger`. Data wake nobody, so it polls when the master said that it would transmit, and
/// while it does not, every kPoll. What it sees too late it follows at once, and counts it (`triggers_late`).
class PingClock {
 public:
  static constexpr SimTime kPoll = std::chrono::milliseconds(10);

  PingClock(Ports& ports, const PingTiming& timing);
  PingClock(const PingClock&) = delete;
  PingClock& operator=(const PingClock&) = delete;

  /// Whether to transmit now: asked at each event. If so, transmitted() or skipped() follows.
  bool due(SimTime now);

  /// Another rate: from the transmission on that is due or comes next.
  void set_rate(Rate rate);

  /// Time to ask next: at the next transmission, or, for a slave, to search for the master's.
  SimTime next() const;

  /// The head has transmitted now and receives for this long.
  void transmitted(SimTime now, SimTime reception);
  /// The head let it pass without transmitting.
  void skipped();

  /// Time of the intended next transmission, for transmit/1; 0: it does not know.
  SimTime intended() const;

 private:
  void follow(const msg::Transmit& master);
  bool follows_now(SimTime now);
  void report_missing(SimTime now);
  void advance();

  Ports& ports_;
  Trigger trigger_;
  Rate rate_;
  SimTime dead_time_;
  SimTime free_{0};  // nothing is transmitted before

  // Free and interleaved.
  SimTime phase_{0};
  std::int64_t beat_ = 0;
  SimTime next_{0};

  // Slave.
  std::deque<SimTime> to_follow_;    // own transmissions that the master has asked for
  SimTime poll_{0};                  // for the master's next
  std::optional<SimTime> expected_;  // of the master, by its own word
  SimTime followed_{-1};             // the master's last transmission: of its ping's first
  std::int64_t followed_ping_ = -1;
};

}  // namespace ensonify
