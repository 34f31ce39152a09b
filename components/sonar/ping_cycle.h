#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "components/runtime/ports.h"
#include "components/sonar/head_inputs.h"
#include "components/sonar/interference.h"
#include "components/sonar/ping_clock.h"
#include "components/sonar/ping_event.h"
#include "messages/sonar.h"

namespace ensonify {

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
  /// Whether to transmit now. A beat at which something stands in the way passes, and health says what it is.
  bool may_transmit(SimTime now);
  /// Time of the next transmission or of the next ping that is ready.
  SimTime next() const;

  Ports& ports_;
  const HeadInputs& inputs_;
  SimTime processing_latency_;
  PingClock clock_;
  Interference others_;
  std::deque<PingUnderWay> under_way_;
  std::int64_t pings_ = 0;
  Ports::Out<msg::Transmit> transmit_out_;
};

}  // namespace ensonify
