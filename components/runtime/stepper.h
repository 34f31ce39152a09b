#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "components/errors/exit_error.h"
#include "components/runtime/ports.h"
#include "components/runtime/rate_limit.h"
#include "messages/codec.h"

namespace ensonify {

/// Names of a process's outputs on the bus.
struct OutTopic {
  std::string topic;
  std::uint32_t topic_id = 0;
};

/// What reaches viewers, by topic: whether somebody watches one, and where a message for them goes.
struct Viewers {
  std::function<bool(const std::string& topic)> watched;
  std::function<void(msg::Packet&&)> send;
  std::function<bool()> late;  // Ports::late
};

/// Runs one node's events in sim time: delivers what is due in the one order that does not depend on arrival, steps,
/// stamps and numbers what is published. Knows no socket and no wall time; the same for every bus.
class Stepper {
 public:
  using Step = std::function<SimTime(SimTime)>;
  using Send = std::function<void(msg::Packet&&)>;

  Stepper(Ports& ports, Step step) : ports_(ports), step_(std::move(step)) {}

  /// Before the first event: who feeds us, what our outputs are called, and where they go.
  void wire(std::vector<Feed> feeds, std::vector<OutTopic> outs, std::map<std::string, std::string> facts,
            std::uint32_t epoch, std::uint32_t rank, Send send, Viewers viewers = {});

  /// A message has arrived; in order per topic. Throws PeerError on a gap in its topic's seq.
  void insert(const msg::Packet& packet);
  /// Nothing of this topic is delivered beyond what has been inserted: what came at time `t` cannot be used.
  void close(std::uint32_t topic_id, SimTime t, const PeerError& why);
  /// Publishers that events have done without since the last call: from the first that would have had such a message.
  struct Unusable {
    SimTime event{0};
    PeerError why;
  };
  std::vector<Unusable> take_unusable() { return std::exchange(unusable_, {}); }
  /// An event has been run that should have seen this message: its publisher broke a promise.
  bool too_late(const msg::Packet& packet) const;

  /// Runs every event up to and including `horizon`, or up to the one that asks for the run's end.
  /// Returns true in the latter case.
  bool run_to(SimTime horizon);

  /// Time of the next event.
  SimTime next() const { return next_; }
  /// Time of the last event run.
  SimTime last() const { return last_; }
  const std::vector<OutTopic>& outs() const { return outs_; }
  /// Number of messages published on each output.
  const std::vector<std::uint64_t>& published() const { return published_; }

 private:
  struct Ending {
    SimTime t{0};
    PeerError why;
  };
  struct Inlet {
    Feed from;
    std::uint64_t expected_seq = 0;
    std::deque<msg::Packet> waiting;
    std::optional<Ending> ending = {};
    bool closed = false;
  };

  void deliver_due(SimTime now);
  void deliver(Inlet& inlet, const msg::Packet& packet, SimTime now);
  void close_due(SimTime now);
  void publish(std::size_t out_index, msg::Body body, msg::Buffer wall_facts);
  LivePlane live_plane();
  msg::Packet packet_of(const OutTopic& topic, const std::string& type, std::uint64_t seq, msg::Body body,
                        msg::Buffer wall_facts) const;

  Ports& ports_;
  Step step_;
  Send send_;
  std::uint32_t epoch_ = 0;
  std::uint32_t rank_ = 0;
  std::vector<Inlet> inlets_;
  std::vector<Unusable> unusable_;
  std::vector<OutTopic> outs_;
  std::vector<std::uint64_t> published_;
  std::vector<RateLimit> limits_;  // of each output
  Viewers viewers_;
  std::vector<OutTopic> lives_;       // of each port for viewers
  std::vector<std::uint64_t> shown_;  // messages to viewers, on each
  SimTime next_{0};
  SimTime last_{-1};
};

/// A component's node behind one interface: what the participant's loop and the in-process runner drive.
class AnyNode {
 public:
  virtual ~AnyNode() = default;
  virtual SimTime step(SimTime now) = 0;
  /// The run has ended in order: files are completed here, where an error can still be reported.
  virtual void finish_run() = 0;
  /// Exit code of the process after an orderly end.
  virtual int exit_code() const = 0;
  /// It has files to complete at whatever end.
  virtual bool completes_files() const { return false; }
};

template <class Node>
class NodeHolder : public AnyNode {
 public:
  NodeHolder(const typename Node::Config& config, Ports& ports) : node_(config, ports) {}
  SimTime step(SimTime now) override { return node_.step(now); }
  void finish_run() override {
    if constexpr (requires { node_.finish_run(); }) node_.finish_run();
  }
  bool completes_files() const override {
    return requires(Node & node) { node.finish_run(); };
  }
  int exit_code() const override {
    if constexpr (requires { node_.exit_code(); }) return node_.exit_code();
    else return 0;
  }
  Node& node() { return node_; }

 private:
  Node node_;
};

}  // namespace ensonify
