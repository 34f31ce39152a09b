#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "components/runtime/sim_time.h"
#include "messages/codec.h"
#include "messages/health.h"

namespace ensonify {

class Injector;

inline constexpr SimTime kFinishMargin = std::chrono::seconds(1);
/// The largest `window_s` of a launch file: how far a publisher may run ahead of its readers. Queues and what a reader
/// accepts must not depend on the file, which a program may not have read.
inline constexpr SimTime kLongestWindow = std::chrono::seconds(5);

struct OutOptions {
  std::size_t max_bytes = 4096;  // of one message's body; queues are sized from it
  Rate rate;                     // highest rate, which it is held to (rate_limit.h); {0}: 10 Hz
};

struct InOptions {
  SimTime delay{0};       // a message published at t is seen at events from t + delay on
  bool optional = false;  // may stay unconnected
  Rate least;             // that its publisher must have; {0}: any
};

/// Declaration of a port: the JSON that `--check` prints and HELLO carries.
struct OutPort {
  std::string port;
  std::string type;
  std::size_t max_bytes = 0;
  Rate rate;
};
/// A port for viewers: its messages go to the live plane alone, and only while somebody subscribes.
struct LivePort {
  std::string port;
  std::string type;
  std::size_t max_bytes = 0;
};
struct InPort {
  std::string port;
  std::string type;  // "*" takes any type
  SimTime delay{0};
  bool optional = false;
  std::vector<std::string> topics;  // given: these names or patterns such as "*" and "bow/*", not the wiring
  std::size_t max_bytes = 0;        // 0: as declared by the publisher
  Rate least = {};                  // InOptions
};

/// One topic that feeds one input of this process, known once the wiring is checked.
struct Feed {
  std::size_t in_index = 0;
  std::string topic;
  std::uint32_t topic_id = 0;
  std::string type;
  std::string publisher;
  std::uint32_t rank = 0;  // of the publisher in the launch file
  SimTime delay{0};
  std::size_t max_bytes = 0;
  Rate rate;                 // highest that the publisher declared
  bool may_be_lost = false;  // the run can go on without its publisher
};

/// What carries messages to viewers; empty where there is none. What it says depends on wall time: nothing else that a
/// node publishes may follow from it.
struct LivePlane {
  std::function<bool(std::size_t live_index)> watched;
  std::function<void(std::size_t live_index, msg::Body)> publish;
  std::function<bool()> late;
};

/// A received message with what its envelope says, for those who need more than its content.
using PacketHandler = std::function<void(const msg::Packet&)>;

/// All that a component sees of the others: typed outputs and inputs. What carries them (in-process, ipc, tcp) is not
/// its business. Inputs are delivered before step(now): exactly the messages with t_sim + delay <= now, each once, in
/// the order (t_sim, publisher, topic, seq).
class Ports {
 public:
  /// `publish(index of out port, body, wall facts)`; set by whatever runs the node.
  using Publish = std::function<void(std::size_t, msg::Body, msg::Buffer)>;

  explicit Ports(std::string process, std::filesystem::path out_dir = ".");
  Ports(const Ports&) = delete;
  Ports& operator=(const Ports&) = delete;

  /// A handle with which a node publishes on one of its ports, at the current event's time.
  template <msg::Message M>
  class Out {
   public:
    void send(const M& message) { ports_->publish(index_, msg::encode(message)); }

   private:
    friend class Ports;
    Out(Ports* ports, std::size_t index) : ports_(ports), index_(index) {}
    Ports* ports_;
    std::size_t index_;
  };

  template <msg::Message M>
  Out<M> out(const std::string& port, OutOptions options = {}) {
    return {this, declare_out({port, M::kType, options.max_bytes, options.rate})};
  }

  /// A handle with which a node shows something to viewers, for whom alone it is made.
  template <msg::Message M>
  class LiveOut {
   public:
    bool watched() const { return ports_->live_.watched && ports_->live_.watched(index_); }
    void send(const M& message) { ports_->live_.publish(index_, msg::encode(message)); }

   private:
    friend class Ports;
    LiveOut(Ports* ports, std::size_t index) : ports_(ports), index_(index) {}
    Ports* ports_;
    std::size_t index_;
  };

  template <msg::Message M>
  LiveOut<M> live_out(const std::string& port, std::size_t max_bytes) {
    return {this, declare_live({port, M::kType, max_bytes})};
  }

  /// The run is behind its pace and waits for this process: not the time to work for viewers.
  bool late() const { return live_.late && live_.late(); }

  template <msg::Message M>
  void in(const std::string& port, std::function<void(const M&)> handler, InOptions options = {}) {
    declare_in({port, M::kType, options.delay, options.optional, {}, 0, options.least},
               [this, handler = std::move(handler)](const msg::Packet& packet) {
                 if (const auto message = sound<M>(packet)) handler(*message);
               });
  }

  /// One type from several publishers: every topic of `topics` (names or patterns such as "*"), which for a name must
  /// be of this type. The handler gets the publisher.
  template <msg::Message M>
  void in_topics(const std::string& port, std::vector<std::string> topics,
                 std::function<void(const std::string& publisher, const M&)> handler, InOptions options = {}) {
    declare_in({port, M::kType, options.delay, options.optional, std::move(topics), 0, options.least},
               [this, handler = std::move(handler)](const msg::Packet& packet) {
                 const auto message = sound<M>(packet);
                 if (message) handler(packet.topic.substr(0, packet.topic.find('/')), *message);
               });
  }

  /// An input whose type is only known at run time; messages come undecoded.
  void in_raw(const std::string& port, const std::string& type, PacketHandler handler, InOptions options = {}) {
    declare_in({port, type, options.delay, options.optional, {}, 0, options.least}, std::move(handler));
  }

  /// Every message of the topics that match `topics` ("*" and "name/*" are patterns), undecoded. For recorders and
  /// assertions, which know no types. A topic of its own is never matched.
  void in_any(const std::string& port, std::vector<std::string> topics, PacketHandler handler) {
    declare_in({port, "*", SimTime{0}, true, std::move(topics), 0}, std::move(handler));
  }

  /// Name of this process in the launch file.
  const std::string& process() const { return process_; }
  /// Folder of the run's output files (`--out`).
  const std::filesystem::path& out_dir() const { return out_dir_; }
  /// Time of the event being run.
  SimTime now() const { return now_; }
  /// Feeds of the inputs, in the order of their ids. Empty in the constructor; complete before the first step.
  const std::vector<Feed>& feeds() const { return feeds_; }
  /// Facts fixed for the run: "launch" and "scenario" (resolved text), "version", "declarations" (declared.h), and
  /// where the launch injects faults "inject" (injections.h). Complete before the first step.
  const std::map<std::string, std::string>& facts() const { return facts_; }

  /// Publishes an undecoded message on a port (replay).
  void publish(std::size_t out_index, msg::Body body, msg::Buffer wall_facts = {});
  /// Declares an output whose type is only known at run time.
  std::size_t declare_out(OutPort port);

  /// Ends the run, for everyone at the same sim time: one second after this event (kFinishMargin). Only a process that
  /// said `may_finish` in its constructor can call it.
  void may_finish() { may_finish_ = true; }
  void finish();

  /// Counts something that happened; the total is published in `health`.
  void count(const std::string& what, std::int64_t by = 1);
  /// State "ok", "degraded" or "failed" and one line why.
  void health(const std::string& state, const std::string& message);

  /// What others want to know of this process before the run (messages/declarations.h); one of each type.
  template <msg::Message M>
  void declare(const M& declaration) {
    declares_.insert_or_assign(M::kType, msg::to_value(declaration));
  }

  /// A declaration whose type is only known at run time (replay).
  void declare(const std::string& type, msg::Value content) { declares_.insert_or_assign(type, std::move(content)); }

  // --- for whatever runs the node ---
  const std::map<std::string, msg::Value>& declares() const { return declares_; }
  const std::vector<OutPort>& outs() const { return outs_; }
  const std::vector<InPort>& ins() const { return ins_; }
  const std::vector<LivePort>& lives() const { return lives_; }
  bool declares_finish() const { return may_finish_; }
  bool finish_requested() const { return finish_requested_; }
  /// Declares the health port, which every process has; called once the node is constructed.
  void seal();
  void connect(std::vector<Feed> feeds, std::map<std::string, std::string> facts, Publish publish, LivePlane live = {});
  void begin_event(SimTime now);
  /// Publishes `health` if it changed, at most once a second.
  void end_event();
  void deliver(std::size_t in_index, const msg::Packet& packet) { handlers_[in_index](packet); }

 private:
  std::size_t declare_in(InPort port, PacketHandler handler);
  std::size_t declare_live(LivePort port);
  void require_new(const std::string& port) const;

  /// The message, or nothing when a number of it is not finite where it must be: counted, and its sender named.
  template <msg::Message M>
  std::optional<M> sound(const msg::Packet& packet) {
    std::optional<M> message = msg::decode<M>(packet.body, packet.body.size());
    if (const std::string field = msg::not_finite(*message); !field.empty()) {
      refuse(packet, field);
      message.reset();
    }
    return message;
  }
  void refuse(const msg::Packet& packet, const std::string& field);

  std::string process_;
  std::filesystem::path out_dir_;
  std::vector<Feed> feeds_;
  std::map<std::string, std::string> facts_;
  std::vector<OutPort> outs_;
  std::vector<InPort> ins_;
  std::vector<LivePort> lives_;
  std::vector<PacketHandler> handlers_;
  Publish publish_;
  LivePlane live_;
  std::shared_ptr<Injector> injector_;  // null: nothing is injected
  SimTime now_{0};
  std::map<std::string, msg::Value> declares_;
  bool may_finish_ = false;
  bool finish_requested_ = false;
  msg::Health health_;
  std::map<std::string, std::int64_t> counters_;
  bool health_changed_ = false;
  SimTime health_due_{0};
  std::size_t health_port_ = 0;
};

/// "*" and whatever ends in it ("bow/*") are patterns; anything else is a name.
inline bool is_pattern(std::string_view topic) { return topic.ends_with('*'); }

/// Whether a name or pattern, as recorders, replays and assertions are given them, means this topic.
inline bool topic_matches(std::string_view wanted, std::string_view topic) {
  return is_pattern(wanted) ? topic.starts_with(wanted.substr(0, wanted.size() - 1)) : wanted == topic;
}

}  // namespace ensonify
