#pragma once

#include <string>

#include "components/runtime/ports.h"
#include "components/sonar/head_config.h"
#include "components/sonar/head_inputs.h"
#include "components/sonar/ping_cycle.h"

namespace ensonify {

/// Node parts of a head with one channel besides its model: inputs, ping cycle, and the
/// port `ping`. Two kinds of event: a transmission, at which the settings of the ping are fixed, and the end of its
/// processing, at which every pose it needs has arrived and it is computed and published.
class SingleChannel {
 public:
  /// Values that follow from the head's parameters.
  struct Plan {
    double longest_reception_s = 0.0;  // with the longest range and pulse that can be set
    std::size_t max_ping_bytes = 0;
    double finest_beam_rad = 0.0;
    bool probe = false;  // for the sound speed at its face
  };
  /// A ping as received, without its track, and what health is to report of it: "" when all is well.
  struct Received {
    msg::Ping ping;
    std::string trouble;
  };

  /// `Config` is a HeadConfig with the start() and limits() of its settings.
  template <class Config>
  SingleChannel(const Config& config, const Plan& plan, Ports& ports)
      : SingleChannel(config, {"", config.start(), config.limits()}, plan, ports) {}

  /// A step of the node. send(settings) gives the Transmission of a ping that goes out now, receive_echoes(ping,
  /// settings) what was Received of one that is complete.
  template <class Send, class Receive>
  SimTime step(SimTime now, const Send& send, const Receive& receive_echoes) {
    return cycle_.step(
        now, [&] { cycle_.transmit(now, {send(inputs_.settings_at_ping())}); },
        [&](const PingUnderWay& ping) { publish(ping, receive_echoes(ping, ping.channels.front().settings)); });
  }

  const frames::PoseHistory& truth() const { return inputs_.truth(); }
  trace::Scene& seabed() { return inputs_.seabed(); }

 private:
  SingleChannel(const HeadConfig& config, const HeadInputs::Channel& channel, const Plan& plan, Ports& ports);
  void publish(const PingUnderWay& ping, Received received);

  HeadInputs inputs_;
  PingCycle cycle_;
  Ports::Out<msg::Ping> ping_out_;
};

}  // namespace ensonify
