#include "components/runtime/bus/link.h"

#include <zmq.hpp>

#include "components/errors/exit_error.h"
#include "components/runtime/bus/gate.h"
#include "components/runtime/bus/receiver.h"
#include "components/runtime/bus/sockets.h"

namespace ensonify::bus {
namespace {
constexpr int kPollMs = 500;                       // how soon a lost clock is noticed
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
    if (keys) gate.emplace(context, *keys);
    if (clock_endpoint.empty()) return;
    connect_control(clock, clock_endpoint, keys);
    const std::string watch = "inproc://clock-monitor";
    if (zmq_socket_monitor(clock.handle(), watch.c_str(), ZMQ_EVENT_DISCONNECTED) == 0) monitor.connect(watch);
  }

  void poll_viewers() {
    if (!polled_viewers) viewers.read(live);
    polled_viewers = true;
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

Link::Link(const std::string& name, const std::string& clock_endpoint, const Address& address, int queue)
    : sockets_(std::make_unique<Sockets>(name, clock_endpoint, address.keys)) {
  sockets_->sync.set(zmq::sockopt::sndhwm, queue);
  sockets_->sync.set(zmq::sockopt::xpub_nodrop, true);
  sockets_->sync.set(zmq::sockopt::sndbuf, kKernelBuffer);
  sockets_->sync.set(zmq::sockopt::linger, kLingerMs);
  sockets_->sync_endpoint = bind_to(sockets_->sync, address, name + ".sync");
  sockets_->live_endpoint = bind_live(sockets_->live, address, name);
}

Link::~Link() { leave(); }

void Link::leave() {
  if (sockets_) sockets_->context.shutdown();
  receiver_.reset();
  sockets_.reset();  // lingers
}

const std::string& Link::sync_endpoint() const { return sockets_->sync_endpoint; }
const std::string& Link::live_endpoint() const { return sockets_->live_endpoint; }

void Link::interrupt() {
  if (sockets_) sockets_->context.shutdown();
}

void Link::send_control(std::string_view text) { sockets_->clock.send(zmq::buffer(text)); }

std::optional<std::string> Link::wait_control() {
  zmq::message_t message;
  if (!sockets_->clock.recv(message)) return std::nullopt;
  return message.to_string();
}

std::optional<std::string> Link::take_control() {
  zmq::message_t message;
  if (!sockets_->clock.recv(message, zmq::recv_flags::dontwait)) return std::nullopt;
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
    if (auto tokens = take_tokens(); !tokens.empty()) return {Event::kTokens, {}, std::move(tokens)};
    if (items[2].revents) return {Event::kClockLost, {}, {}};
  }
}

std::vector<std::string> Link::take_tokens() {
  std::vector<std::string> tokens;
  for (const std::string& asked : sockets_->participants.read(sockets_->sync)) {
    if (asked.starts_with('~')) tokens.push_back(asked.substr(1));
  }
  return tokens;
}

void Link::subscribe(const std::vector<Subscription>& subscriptions, std::uint32_t epoch) {
  if (receiver_) receiver_->begin(subscriptions, epoch);
  else receiver_ = std::make_unique<Receiver>(sockets_->context, subscriptions, epoch, sockets_->keys);
}

Link::Arrived Link::wait_arrived(const TopicCounts& counts, std::chrono::milliseconds patience) {
  return receiver_->wait_arrived(counts, patience);
}

void Link::refuse_missing(const TopicCounts& counts) { receiver_->refuse_missing(counts); }

void Link::lost(const std::string& publisher) { receiver_->lost(publisher); }

void Link::expect_until(SimTime t) { receiver_->expect_until(t); }

std::vector<msg::Packet> Link::take() { return receiver_->take(); }

std::vector<Unusable> Link::take_unusable() { return receiver_->take_unusable(); }

bool Link::is_watched(const std::string& topic) {
  sockets_->poll_viewers();
  return sockets_->viewers.has_subscriber(topic);
}

void Link::publish_live(const msg::Packet& packet) {
  std::vector<zmq::message_t> frames = to_frames(packet);
  send_frames(sockets_->live, frames);
}

void Link::publish(const msg::Packet& packet) {
  Sockets& s = *sockets_;
  s.poll_viewers();
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
