#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "components/errors/exit_error.h"
#include "components/runtime/bus/keys.h"
#include "components/runtime/sim_time.h"
#include "messages/codec.h"

namespace ensonify::bus {

/// Transport of sockets: in the run directory (`ipc`), or on an interface of this machine (`tcp`).
struct Address {
  bool tcp = false;
  std::string run_dir;
  std::string host = "127.0.0.1";
  int port = 0;              // 0: chosen at bind
  std::optional<Keys> keys;  // of tcp; none is for the loopback interface alone
};

/// The address of this machine by which it reaches a `tcp://` endpoint. Throws UserError.
std::string host_towards(const std::string& endpoint);

/// A topic to receive.
struct Subscription {
  std::string topic;
  std::uint32_t topic_id = 0;
  std::string type;
  std::string endpoint;
  std::string token;
  std::size_t max_bytes = 0;
  std::string publisher;
  std::uint32_t rank = 0;  // of the publisher
  Rate rate;               // highest that it declared
  bool may_be_lost = false;
};

/// A topic of which nothing more is taken, for what came at time `t` cannot be used.
struct Unusable {
  std::uint32_t topic_id = 0;
  SimTime t{0};
  PeerError why;
};

class Receiver;

/// One process's sockets: a DEALER to the clock, two XPUBs (sync: nothing lost; live: lossy, for viewers) and a SUB
/// that a thread of its own drains at all times. ZeroMQ is seen in this folder only.
class Link {
 public:
  /// Connects to the clock and binds; "" for one whose clock is in this process, and talks to it otherwise. Throws
  /// UserError for an address that cannot be bound or a path over 107 bytes.
  Link(const std::string& name, const std::string& clock_endpoint, const Address& address, int queue);
  ~Link();

  const std::string& sync_endpoint() const;
  const std::string& live_endpoint() const;

  void send_control(std::string_view text);
  /// The next event. Blocks; `clock_lost` when the clock's socket went away. Throws what the receiving thread threw.
  struct Event {
    enum Kind { kControl, kTokens, kClockLost } kind = kControl;
    std::string control;
    std::vector<std::string> tokens;  // subscribers that have reached our sync socket
  };
  Event wait();
  /// Subscribers that have reached our sync socket since the last call, by their tokens.
  std::vector<std::string> take_tokens();

  /// From any thread: whatever waits in this Link, or will, throws. Nothing can be sent any more.
  void interrupt();
  /// Returns when all that was sent has left. Nothing else may be called after it.
  void leave();

  /// The clock's next message; nothing after a while without one. Half the price of wait(), which then states why.
  std::optional<std::string> wait_control();
  /// The same, if it has come already.
  std::optional<std::string> take_control();

  /// Starts receiving. The token of each topic is subscribed after the topic itself. Again, for a later epoch: the same
  /// topics of the same publishers; what has come of the epoch before is dropped, and so is what still comes of it.
  void subscribe(const std::vector<Subscription>& subscriptions, std::uint32_t epoch);
  /// Waits until the first `count` messages of each topic id have arrived. Throws what the receiving thread threw.
  using TopicCounts = std::vector<std::pair<std::uint32_t, std::uint64_t>>;
  enum class Arrived { kAll, kSome, kNothing };  // at the latest after `patience`
  Arrived wait_arrived(const TopicCounts& counts, std::chrono::milliseconds patience = std::chrono::hours(1));
  /// What has not arrived will not be awaited any more: PeerError, or for who may be lost the end of the topic.
  void refuse_missing(const TopicCounts& counts);
  /// This publisher is no more. What it has sent still comes for a second; then nothing more is awaited.
  void lost(const std::string& publisher);
  /// No message can come with a later time than this: a sender that goes beyond it is refused. kNever: nothing will be
  /// read any more, so nothing is kept.
  void expect_until(SimTime t);
  /// Everything received since the last call, in order per topic.
  std::vector<msg::Packet> take();
  /// Topics that have come to such an end since the last call: of publishers that may be lost. The mistakes of others
  /// are thrown.
  std::vector<Unusable> take_unusable();

  /// To observers at once, never waiting. To participants with the next flush(): none of them acts on a message before
  /// its publisher is done, and many small ones together cost a fraction of the switches between threads. What they
  /// would hold in memory is bounded; beyond it they go. Blocks while a participant's queue is full.
  void publish(const msg::Packet& packet);
  void flush();

  /// Whether an observer has subscribed to this topic.
  bool is_watched(const std::string& topic);
  /// To observers alone.
  void publish_live(const msg::Packet& packet);

 private:
  struct Sockets;
  std::unique_ptr<Sockets> sockets_;
  std::unique_ptr<Receiver> receiver_;
};

}  // namespace ensonify::bus
