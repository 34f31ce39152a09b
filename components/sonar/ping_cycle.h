#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "components/runtime/ports.h"
#include "components/sonar/head_config.h"
#include "components/sonar/head_inputs.h"
#include "components/sonar/sea_acoustics.h"
#include "components/sonar/silence.h"
#include "kernels/acoustics/echo/interference.h"
#include "messages/sonar.h"

namespace ensonify {

/// Transmissions of the vehicle's other heads during reception. With heads to receive it has the input `transmits`,
/// delayed: heads may receive each other, and what was sent up to the last echo has arrived when the ping is computed.
class Interference {
 public:
  /// `latency` is that from the last echo to the computation.
  Interference(Ports& ports, const HeadInputs& inputs, const std::vector<OtherHead>& others, SimTime latency);
  Interference(const Interference&) = delete;
  Interference& operator=(const Interference&) = delete;

  /// Transmissions that may be received by a ping that left at `transmit` and receives for `reception`: straight, and
  /// by the mirror of a level seabed, as deep everywhere as below the head. By the true poses of the vehicle.
  std::vector<echo::InterferingTransmission> during(SimTime transmit, SimTime reception) const;

 private:
  struct Received {
    const OtherHead* from;
    msg::Transmit sent;
  };

  const HeadInputs& inputs_;
  std::vector<OtherHead> others_;
  std::deque<Received> received_;
};

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

/// Transmission of one channel of a head, and the end of its reception.
struct Transmission {
  double frequency_hz = 0.0;
  double pulse_length_s = 0.0;
  SimTime reception{0};  // from the ping's time of transmission to the end of the last echo
  HeadSettings settings;
  double bandwidth_hz = 0.0;  // that a chirp sweeps
  SimTime delay{0};           // after the ping's time of transmission
};

/// A ping from its transmission to the end of its processing: what was fixed when it was sent.
struct PingUnderWay {
  std::int64_t ping = 0;
  SimTime transmit{0};
  std::vector<Transmission> channels;  // of one head
  SimTime ready{0};                    // its last echo has come and is processed, every pose that it needs is known

  std::vector<echo::InterferingTransmission> interfering = {};  // what other heads send meanwhile

  PingEvent event(std::size_t channel = 0) const {
    return {ping, transmit, channels[channel].settings.range_m, interfering};
  }
};

/// The pings of a head from transmission to publication, and its ports `transmit`, `trigger` and `transmits`
/// (PingClock, Interference).
class PingCycle {
 public:
  PingCycle(Ports& ports, const HeadInputs& inputs, const PingTiming& timing);

  /// A step of a node: publish(ping) of every ping that is ready by now, then transmit() if a ping may go out. Returns
  /// the time of the next step.
  template <class Transmit, class Publish>
  SimTime step(SimTime now, const Transmit& transmit, const Publish& publish) {
    while (const auto ping = ready(now)) publish(*ping);
    if (may_transmit(now)) transmit();
    return next();
  }

  /// The next ping goes out. Each channel is published in transmit/1 now, with its own time, the earliest first. The
  /// first channel's settings give the ping rate.
  void transmit(SimTime now, std::vector<Transmission> channels);

  /// A ping was published. Health reports `trouble`, or if there is none, whether the ping lacks its track.
  void published(const std::string& trouble);

 private:
  /// The oldest ping that is ready by now; each is given once.
  std::optional<PingUnderWay> ready(SimTime now);
  /// Whether to transmit now. A beat at which something stands in the way passes, and health and log say what it is.
  bool may_transmit(SimTime now);
  /// Time of the next transmission or of the next ping that is ready.
  SimTime next() const;

  Ports& ports_;
  const HeadInputs& inputs_;
  SimTime processing_latency_;
  PingClock clock_;
  Silence silence_;
  Interference others_;
  std::deque<PingUnderWay> under_way_;
  std::int64_t pings_ = 0;
  Ports::Out<msg::Transmit> transmit_out_;
};

}  // namespace ensonify
