#include "components/runtime/bus/link.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <zmq.hpp>

#include "components/errors/exit_error.h"
#include "components/runtime/bus/gate.h"
#include "components/runtime/bus/sockets.h"
#include "components/runtime/peer.h"
#include "components/runtime/ports.h"
#include "components/runtime/rate_limit.h"

namespace ensonify::bus {
namespace {
constexpr std::uint32_t kFirstEpoch = 1;
constexpr int kPollMs = 500;  // how soon a lost clock is noticed
constexpr std::size_t kLeastLargestFrame = 1 << 24;
constexpr std::size_t kHoldAtMostBytes = 1 << 14;  // a larger message is better under way while its publisher works on
}  // namespace

struct Link::Sockets {
  Sockets(const std::string& name, const std::string& clock_endpoint, const std::optional<Keys>& run_keys)
      : keys(run_keys),
        clock(context, zmq::socket_type::dealer),
        sync(context, zmq::socket_type::xpub),
        live(context, zmq::socket_type::xpub),
        monitor(context, zmq::socket_type::pair) {
    clock.set(zmq::sockopt::routing_id, name);
    clock.set(zmq::sockopt::rcvtimeo, kPollMs);
    connect_control(clock, clock_endpoint, keys);
    if (keys) gate.emplace(context, *keys);
    const std::string watch = "inproc://clock-monitor";
    if (zmq_socket_monitor(clock.handle(), watch.c_str(), ZMQ_EVENT_DISCONNECTED) == 0) monitor.connect(watch);
  }

  zmq::context_t context{1};
  std::optional<Keys> keys;
  std::optional<Gate> gate;
  zmq::socket_t clock;
  zmq::socket_t sync;
  zmq::socket_t live;
  zmq::socket_t monitor;
  std::string sync_endpoint;
  std::string live_endpoint;
  Subscribers participants;
  Subscribers viewers;
  bool polled_viewers = false;                    // since the last flush: asking costs a system call
  std::vector<std::vector<zmq::message_t>> held;  // for participants, until the next flush
  std::size_t held_bytes = 0;
};

/// The thread that drains the SUB socket whether or not a grant has come, and what it has received.
struct Link::Receiver {
  Receiver(zmq::context_t& context, const std::vector<Subscription>& subscriptions, std::uint32_t first_epoch,
           const std::optional<Keys>& keys)
      : socket(context, zmq::socket_type::sub) {
    if (keys) set_connected(socket, *keys);
    socket.set(zmq::sockopt::rcvhwm, 0);  // the clock's window bounds what can arrive
    socket.set(zmq::sockopt::rcvbuf, kKernelBuffer);
    socket.set(zmq::sockopt::linger, 0);
    socket.set(zmq::sockopt::reconnect_ivl, kReconnectMs);
    std::set<std::string> connected;
    std::size_t largest = kLeastLargestFrame;
    for (const Subscription& s : subscriptions) largest = std::max(largest, 2 * s.max_bytes);
    socket.set(zmq::sockopt::maxmsgsize, static_cast<std::int64_t>(largest));  // a frame beyond all sense cuts the line
    begin(subscriptions, first_epoch);
    for (const Subscription& s : subscriptions) {
      if (connected.insert(s.endpoint).second) connect(s);
    }
    for (const Subscription& s : subscriptions) socket.set(zmq::sockopt::subscribe, s.topic + '\0');
    for (const Subscription& s : subscriptions) socket.set(zmq::sockopt::subscribe, "~" + s.token);
    thread = std::thread([this] { drain(); });
  }

  /// Expects an epoch's messages from its first on.
  void begin(const std::vector<Subscription>& subscriptions, std::uint32_t its_number) {
    const std::lock_guard lock(mutex);
    epoch = its_number;
    inputs.clear();
    for (const Subscription& s : subscriptions) inputs.try_emplace(s.topic_id, s);
    packets.clear();
    latest = kLongestWindow.count();
  }

  void connect(const Subscription& s) {
    try {
      socket.connect(s.endpoint);
    } catch (const zmq::error_t& e) {
      throw PeerError(kExitDied, s.publisher,
                      s.publisher + " cannot be reached: sync: " + s.endpoint + ": " + e.what());
    }
  }

  void drain() {
    try {
      std::vector<zmq::message_t> frames;
      while (receive_frames(socket, frames)) take(std::move(frames));
    } catch (const zmq::error_t& e) {  // also ETERM, after interrupt()
      fail(std::make_exception_ptr(DataLost(std::string("receiving: ") + e.what())));
    } catch (...) {
      fail(std::current_exception());
    }
    socket.close();
  }

  /// Whose topic the message came on says whose mistake it is.
  void take(std::vector<zmq::message_t>&& frames) {
    const std::string came_on = frames[0].to_string();
    const std::lock_guard lock(mutex);
    try {
      msg::Packet packet = to_packet(std::move(frames));
      const auto known = inputs.find(packet.envelope.topic_id);
      if (known == inputs.end() || packet.topic != known->second.subscription.topic)
        throw msg::DecodeError("envelope: topic id is " + std::to_string(packet.envelope.topic_id));
      accept(known->second, std::move(packet));
    } catch (const msg::DecodeError& e) {
      for (const auto& [id, input] : inputs) {
        const Subscription& s = input.subscription;
        if (came_on.starts_with(s.topic + '\0') || came_on.starts_with("~" + s.token))
          throw broken_message(s.publisher, s.topic, input.arrived, e.what());
      }
      throw;
    }
  }

  struct Input {
    explicit Input(const Subscription& s) : subscription(s), limit(s.rate) {}
    Subscription subscription;
    RateLimit limit;
    SimTime last{0};            // time of the last message
    std::uint64_t arrived = 0;  // the next message's seq
  };

  void accept(Input& input, msg::Packet&& packet) {
    const Subscription& s = input.subscription;
    const msg::Envelope& e = packet.envelope;
    const auto broken = [&](const std::string& what) { throw broken_message(s.publisher, s.topic, e.seq, what); };
    if (e.epoch >= kFirstEpoch && e.epoch < epoch) return;
    if (e.epoch != epoch) broken("epoch: is " + std::to_string(e.epoch));
    if (e.publisher != s.rank) broken("publisher: is " + std::to_string(e.publisher));
    if (e.type_hash != msg::type_hash(s.type)) broken("type hash: is not that of " + s.type);
    if (packet.body.size() > s.max_bytes)
      broken(std::to_string(packet.body.size()) + " bytes, declared at most " + std::to_string(s.max_bytes));
    const SimTime t{e.t_sim_ns};
    if (t < input.last || t > SimTime{latest.load()})
      broken("t_sim: " + std::to_string(e.t_sim_ns) +
             " ns is before the message before it, or beyond what was granted");
    if (e.seq != input.arrived) throw lost_messages(s.publisher, s.topic, input.arrived, e.seq);
    if (!input.limit.take(1, t)) broken("t_sim: " + input.limit.text());
    input.last = t;
    ++input.arrived;
    if (latest.load() != kNever.count()) packets.push_back(std::move(packet));
    if (awaited && all_arrived(*awaited)) news.notify_one();
  }

  /// The topics of which something is still to come, for messages.
  PeerError missing(const TopicCounts& counts) const {
    for (const auto& [id, count] : counts) {
      const auto found = inputs.find(id);
      if (found == inputs.end() || found->second.arrived >= count) continue;
      const Subscription& s = found->second.subscription;
      return {kExitDataLost, s.publisher,
              s.publisher + " lost messages: " + s.topic + ": its DONE counted " + std::to_string(count) + ", " +
                  std::to_string(found->second.arrived) + " have come"};
    }
    return {kExitDataLost, "", "a message is missing"};
  }

  bool all_arrived(const TopicCounts& counts) const {
    return std::all_of(counts.begin(), counts.end(), [this](const auto& count) {
      const auto found = inputs.find(count.first);
      return count.second == 0 || (found != inputs.end() && found->second.arrived >= count.second);
    });
  }

  void rethrow() {
    const std::lock_guard lock(mutex);
    if (error) std::rethrow_exception(error);
  }

  void fail(std::exception_ptr why) {
    const std::lock_guard lock(mutex);
    error = std::move(why);
    news.notify_one();
  }

  zmq::socket_t socket;
  std::atomic<std::int64_t> latest{kLongestWindow.count()};  // sim time beyond which nothing can be sent
  std::thread thread;
  std::mutex mutex;  // of all that follows
  std::uint32_t epoch = kFirstEpoch;
  std::map<std::uint32_t, Input> inputs;  // by topic id
  std::condition_variable news;
  const TopicCounts* awaited = nullptr;  // what the other thread sleeps for: it is not woken for less
  std::vector<msg::Packet> packets;
  std::exception_ptr error;
};

Link::Link(const std::string& name, const std::string& clock_endpoint, const Address& address, int queue)
    : sockets_(std::make_unique<Sockets>(name, clock_endpoint, address.keys)) {
  sockets_->sync.set(zmq::sockopt::sndhwm, queue);
  sockets_->sync.set(zmq::sockopt::xpub_nodrop, true);
  sockets_->sync.set(zmq::sockopt::sndbuf, kKernelBuffer);
  sockets_->sync.set(zmq::sockopt::linger, kLingerMs);
  sockets_->sync_endpoint = bind_to(sockets_->sync, address, name + ".sync");
  sockets_->live_endpoint = bind_live(sockets_->live, address, name);
}

Link::~Link() {
  sockets_->context.shutdown();
  if (receiver_) receiver_->thread.join();
}

const std::string& Link::sync_endpoint() const { return sockets_->sync_endpoint; }
const std::string& Link::live_endpoint() const { return sockets_->live_endpoint; }

void Link::interrupt() { sockets_->context.shutdown(); }

void Link::send_control(std::string_view text) { sockets_->clock.send(zmq::buffer(text)); }

std::optional<std::string> Link::wait_control() {
  zmq::message_t message;
  if (!sockets_->clock.recv(message)) return std::nullopt;
  return message.to_string();
}

Link::Event Link::wait() {
  zmq::pollitem_t items[] = {{sockets_->clock.handle(), 0, ZMQ_POLLIN, 0},
                             {sockets_->sync.handle(), 0, ZMQ_POLLIN, 0},
                             {sockets_->monitor.handle(), 0, ZMQ_POLLIN, 0}};
  while (true) {
    zmq::poll(items, 3, std::chrono::milliseconds(kPollMs));
    if (receiver_) receiver_->rethrow();
    zmq::message_t message;
    if (items[0].revents && sockets_->clock.recv(message, zmq::recv_flags::dontwait)) {
      return {Event::kControl, message.to_string(), {}};
    }
    Event event{Event::kTokens, {}, {}};
    for (const std::string& asked : sockets_->participants.read(sockets_->sync)) {
      if (asked.starts_with('~')) event.tokens.push_back(asked.substr(1));
    }
    if (!event.tokens.empty()) return event;
    if (items[2].revents) return {Event::kClockLost, {}, {}};
  }
}

void Link::subscribe(const std::vector<Subscription>& subscriptions, std::uint32_t epoch) {
  if (receiver_) receiver_->begin(subscriptions, epoch);
  else receiver_ = std::make_unique<Receiver>(sockets_->context, subscriptions, epoch, sockets_->keys);
}

void Link::wait_arrived(const TopicCounts& counts, std::chrono::milliseconds patience) {
  std::unique_lock lock(receiver_->mutex);
  receiver_->awaited = &counts;
  std::size_t before = receiver_->packets.size();
  for (std::chrono::milliseconds waited{0}; !receiver_->news.wait_for(lock, std::chrono::milliseconds(kPollMs), [&] {
         return receiver_->error || receiver_->all_arrived(counts);
       });) {
    waited = receiver_->packets.size() == before ? waited + std::chrono::milliseconds(kPollMs)
                                                 : std::chrono::milliseconds(0);
    before = receiver_->packets.size();
    if (waited < patience) continue;
    receiver_->awaited = nullptr;
    throw receiver_->missing(counts);
  }
  receiver_->awaited = nullptr;
  if (receiver_->error) std::rethrow_exception(receiver_->error);
}

void Link::expect_until(SimTime t) { receiver_->latest = t.count(); }

std::vector<msg::Packet> Link::take() {
  const std::lock_guard lock(receiver_->mutex);
  return std::exchange(receiver_->packets, {});
}

void Link::publish(const msg::Packet& packet) {
  Sockets& s = *sockets_;
  if (!s.polled_viewers) s.viewers.read(s.live);
  s.polled_viewers = true;
  const bool subscribed = s.participants.has_subscriber(packet.topic);
  if (!subscribed && s.viewers.empty()) return;

  std::vector<zmq::message_t> frames = to_frames(packet);
  if (!s.viewers.empty()) send_frames(s.live, frames);
  if (!subscribed) return;
  s.held.push_back(std::move(frames));
  s.held_bytes += packet.body.size();
  if (s.held_bytes > kHoldAtMostBytes) flush();
}

void Link::flush() {
  Sockets& s = *sockets_;
  for (std::vector<zmq::message_t>& frames : s.held) send_frames(s.sync, frames);
  s.held.clear();
  s.held_bytes = 0;
  s.polled_viewers = false;
}

}  // namespace ensonify::bus
