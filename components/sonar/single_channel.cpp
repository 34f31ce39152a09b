#include "components/sonar/single_channel.h"

namespace ensonify {
namespace {

HeadInputs::Start start_of(const HeadConfig& config, const HeadInputs::Channel& channel,
                           const SingleChannel::Plan& plan) {
  HeadInputs::Start start;
  start.mounting = config.mounting;
  start.tide = config.world.vertical.tide;
  start.lod = config.lod;
  start.longest_ping = from_seconds(plan.longest_reception_s + config.processing_latency_s);
  start.sound_speed_mps = config.sound_speed_mps;
  start.probe = plan.probe;
  start.channels = {channel};
  return start;
}

}  // namespace

SingleChannel::SingleChannel(const HeadConfig& config, const HeadInputs::Channel& channel, const Plan& plan,
                             Ports& ports)
    : inputs_(ports, start_of(config, channel, plan)),
      cycle_(ports, inputs_, config.timing()),
      ping_out_(ports.out<msg::Ping>("ping", {.max_bytes = plan.max_ping_bytes, .rate = config.timing().rate})) {
  ports.note("finest_beam_rad", plan.finest_beam_rad);
}

void SingleChannel::publish(const PingUnderWay& ping, Received received) {
  inputs_.fill_track(received.ping.track, ping.transmit, ping.channels.front().reception);
  ping_out_.send(received.ping);
  cycle_.published(received.trouble);
}

}  // namespace ensonify
