#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>
#include <zmq.hpp>

#include "components/runtime/bus/link.h"
#include "components/runtime/peer.h"
#include "components/runtime/ports.h"
#include "components/runtime/rate_limit.h"

namespace ensonify::bus {

/// Drains a SUB socket in a thread of its own, whether or not a grant has come, and keeps what it has received.
class Receiver {
 public:
  Receiver(zmq::context_t& context, const std::vector<Subscription>& subscriptions, std::uint32_t epoch,
           const std::optional<Keys>& keys);
  /// Once the context has been shut down.
  ~Receiver() { thread_.join(); }
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  /// Expects an epoch's messages from its first on.
  void begin(const std::vector<Subscription>& subscriptions, std::uint32_t epoch);
  Link::Arrived wait_arrived(const Link::TopicCounts& counts, std::chrono::milliseconds patience);
  void refuse_missing(const Link::TopicCounts& counts);
  void lost(const std::string& publisher);
  void expect_until(SimTime t) { latest_ = t.count(); }
  std::vector<msg::Packet> take();
  std::vector<Unusable> take_unusable();
  /// Throws what the thread threw.
  void rethrow();

 private:
  struct Input {
    explicit Input(const Subscription& s) : subscription(s), limit(s.rate) {}
    Subscription subscription;
    RateLimit limit;
    SimTime last{0};                                                          // time of the last message
    std::uint64_t arrived = 0;                                                // the next message's seq
    std::optional<std::chrono::steady_clock::time_point> awaited_until = {};  // of a publisher that is lost
    bool closed = false;                                                      // what has not come is not taken any more
  };

  void connect(const Subscription& s);
  void drain();
  void judge(std::vector<zmq::message_t>&& frames);
  void accept(Input& input, msg::Packet&& packet);
  void refuse(Input& input, const PeerError& why, std::optional<SimTime> t = {});
  bool all_arrived(const Link::TopicCounts& counts) const;
  void close_lost(const Link::TopicCounts& counts);
  void fail(std::exception_ptr why);

  zmq::socket_t socket_;
  std::atomic<std::int64_t> latest_{kLongestWindow.count()};  // sim time beyond which nothing can be sent
  std::mutex mutex_;                                          // of all that follows
  std::uint32_t epoch_ = 0;
  std::map<std::uint32_t, Input> inputs_;  // by topic id
  std::condition_variable news_;
  const Link::TopicCounts* awaited_ = nullptr;  // what the other thread sleeps for: it is not woken for less
  std::vector<msg::Packet> packets_;
  std::vector<Unusable> unusable_;
  std::exception_ptr error_;
  std::thread thread_;
};

}  // namespace ensonify::bus
