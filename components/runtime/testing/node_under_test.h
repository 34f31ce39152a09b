#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "components/runtime/paced.h"
#include "components/runtime/stepper.h"

namespace ensonify {

/// A node alone on a `local:` bus: no sockets, no sleeps, no threads. Give it messages, let sim time pass, examine what
/// it published.
///
///   NodeUnderTest<MultibeamNode> head({.frequency_hz = 300e3});
///   head.give("pose", resting_pose(0_s), resting_pose(1_s));
///   const auto pings = head.step_until<msg::Ping>("ping", 1_s);
template <class Node>
class NodeUnderTest {
 public:
  explicit NodeUnderTest(const typename Node::Config& config, std::string process = "test",
                         std::filesystem::path out_dir = ".")
      : ports_(std::move(process), std::move(out_dir)),
        node_(config, ports_),
        stepper_(ports_, [this](SimTime now) { return node_.step(now); }) {
    ports_.seal();
    std::vector<Feed> feeds;
    for (std::size_t i = 0; i < ports_.ins().size(); ++i) {
      const InPort& in = ports_.ins()[i];
      if (in.type == "*") continue;  // given by topic: connect_any
      for (const std::string& topic : in.topics) {
        const auto id = static_cast<std::uint32_t>(1000 + feeds.size());
        feeds.push_back({i, topic, id, in.type, topic.substr(0, topic.find('/')), id, in.delay, in.max_bytes});
      }
      if (!in.topics.empty()) continue;
      feeds.push_back(
          {i, "given/" + in.port, static_cast<std::uint32_t>(i), in.type, "given", 0, in.delay, in.max_bytes});
    }
    feeds_ = feeds;
  }

  /// Connects a topic of any kind to an `in_any` port; before the first step.
  void connect_any(const std::string& port, const std::string& topic, const std::string& type) {
    for (std::size_t i = 0; i < ports_.ins().size(); ++i) {
      if (ports_.ins()[i].port != port) continue;
      const auto id = static_cast<std::uint32_t>(1000 + feeds_.size());
      feeds_.push_back({i, topic, id, type, topic.substr(0, topic.find('/')), id, ports_.ins()[i].delay, 0});
    }
  }

  /// Publishes messages to an input port (for in_topics and in_any: a topic that it lists or is connected to), in the
  /// order given, each at its stamp_ns or, for types without one, at the time of the last event.
  template <msg::Message... M>
  void give(const std::string& port, const M&... messages) {
    (give_at(port, stamp(messages), messages), ...);
  }

  template <msg::Message M>
  void give_at(const std::string& port, SimTime t, const M& message) {
    give_body(port, t, msg::encode(message), msg::type_hash(M::kType));
  }

  /// A message of any content.
  void give_body(const std::string& port, SimTime t, msg::Body body, std::uint64_t type_hash = 0) {
    start();
    for (const Feed& c : feeds_) {
      if (c.topic != "given/" + port && c.topic != port) continue;
      msg::Packet packet;
      packet.topic = c.topic;
      packet.envelope.topic_id = c.topic_id;
      packet.envelope.publisher = c.rank;
      packet.envelope.type_hash = type_hash;
      packet.envelope.seq = seq_[c.topic_id]++;
      packet.envelope.t_sim_ns = t.count();
      packet.body = std::move(body);
      stepper_.insert(packet);
      return;
    }
    throw std::invalid_argument("no input port " + port);
  }

  /// Gives what `make(t)` returns at each t from 0 to `until`.
  template <class Make>
  void give_each(const std::string& port, SimTime until, SimTime period, const Make& make) {
    for (SimTime t{0}; t <= until; t += period) give(port, make(t));
  }

  /// Runs every event up to and including `t`; returns what was published on `port` since it was last asked for.
  template <msg::Message M>
  std::vector<M> step_until(const std::string& port, SimTime t) {
    run_until(t);
    std::vector<M> messages;
    for (const msg::Packet& packet : take(port)) messages.push_back(msg::decode<M>(packet.body, packet.body.size()));
    return messages;
  }

  void run_until(SimTime t) {
    start();
    if (stepper_.run_to(t)) finished_ = true;
  }

  /// From now on somebody watches the ports for viewers, and the run waits for this node or not. What they get is taken
  /// as what is published.
  void watch(bool late = false) {
    watched_ = true;
    late_ = late;
  }

  /// Sim time is to follow wall time; before the first message and the first step.
  void pace() { facts_[kPacedFact] = "true"; }

  /// Packets published on `port` since it was last asked for.
  std::vector<msg::Packet> take(const std::string& port) { return std::exchange(published_["test/" + port], {}); }

  Node& node() { return node_; }
  Ports& ports() { return ports_; }
  SimTime next() const { return stepper_.next(); }
  /// The node asked for the run's end.
  bool finished() const { return finished_; }

 private:
  template <class M>
  SimTime stamp(const M& message) const {
    if constexpr (requires { message.stamp_ns; }) return SimTime{message.stamp_ns};
    else return std::max(stepper_.last(), SimTime{0});
  }

  void start() {
    if (started_) return;
    started_ = true;
    std::vector<OutTopic> outs;
    for (const OutPort& out : ports_.outs())
      outs.push_back({"test/" + out.port, static_cast<std::uint32_t>(outs.size())});
    const auto keep = [this](msg::Packet&& packet) { published_[packet.topic].push_back(std::move(packet)); };
    stepper_.wire(feeds_, std::move(outs), facts_, 1, 1, keep,
                  {[this](const std::string&) { return watched_; }, keep, [this] { return late_; }});
  }

  Ports ports_;
  Node node_;
  Stepper stepper_;
  std::vector<Feed> feeds_;
  std::map<std::string, std::string> facts_;
  std::map<std::uint32_t, std::uint64_t> seq_;
  std::map<std::string, std::vector<msg::Packet>> published_;
  bool started_ = false;
  bool finished_ = false;
  bool watched_ = false;
  bool late_ = false;
};

}  // namespace ensonify
