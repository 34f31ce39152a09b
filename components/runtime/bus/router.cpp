#include "components/runtime/bus/router.h"

#include <sys/timerfd.h>
#include <unistd.h>

#include <atomic>
#include <zmq.hpp>

#include "components/runtime/bus/gate.h"
#include "components/runtime/bus/sockets.h"
#include "components/runtime/log.h"

namespace ensonify::bus {
namespace {

// A plain blocking receive costs half of what polling a socket and a timer does; the timer is for the last stretch.
constexpr std::chrono::milliseconds kCoarse{50};

// What one peer may have on its way to and from the clock: a participant waits for answers, a tool need not.
constexpr int kQueueOfPeer = 1000;
constexpr std::int64_t kLargestControl = 1 << 26;

bool receive(zmq::socket_t& socket, Router::Message& message, zmq::recv_flags flags) {
  zmq::message_t from;
  zmq::message_t text;
  try {
    if (!socket.recv(from, flags)) return false;
  } catch (const zmq::error_t&) {  // a signal: the caller checks why
    return false;
  }
  message.from = from.to_string();
  const char* address = zmq_msg_gets(from.handle(), "Peer-Address");  // nothing over ipc
  message.address = address != nullptr ? address : "";
  message.text.clear();
  for (bool more = from.more(); more; more = text.more()) {
    if (!socket.recv(text, zmq::recv_flags::none)) return false;
    message.text = text.to_string();
  }
  return true;
}

/// Named in the log, up to a number: whoever knocks without end shall not fill the disk.
void turned_away(const std::string& address, const std::string& why) {
  static std::atomic<int> count{0};
  constexpr int kMost = 100;
  if (count++ < kMost) log::line("clock", SimTime{0}, "turned_away", "address=" + address + " why=\"" + why + "\"");
}

}  // namespace

struct Router::Sockets {
  zmq::context_t context{1};
  std::optional<Gate> gate;
  zmq::socket_t socket{context, zmq::socket_type::router};
  zmq::socket_t live{context, zmq::socket_type::xpub};
  Subscribers viewers;
  int alarm = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);  // zmq_poll alone knows milliseconds only
  std::string endpoint;
  std::string live_endpoint;
};

Router::Router(const Address& address) : sockets_(std::make_unique<Sockets>()) {
  zmq::socket_t& socket = sockets_->socket;
  socket.set(zmq::sockopt::router_mandatory, true);
  socket.set(zmq::sockopt::router_handover, false);
  socket.set(zmq::sockopt::linger, kLingerMs);
  socket.set(zmq::sockopt::rcvtimeo, static_cast<int>(kCoarse.count()));
  socket.set(zmq::sockopt::sndhwm, kQueueOfPeer);
  socket.set(zmq::sockopt::rcvhwm, kQueueOfPeer);
  socket.set(zmq::sockopt::maxmsgsize, kLargestControl);
  if (address.keys) sockets_->gate.emplace(sockets_->context, *address.keys, turned_away);
  sockets_->endpoint = bind_to(socket, address, "clock");
  Address any_port = address;
  any_port.port = 0;
  sockets_->live_endpoint = bind_live(sockets_->live, any_port, "clock");
}

Router::~Router() { close(sockets_->alarm); }

const std::string& Router::endpoint() const { return sockets_->endpoint; }

std::optional<Router::Message> Router::wait(std::optional<WallTime> until) {
  using namespace std::chrono;
  if (!until || *until - steady_clock::now() > kCoarse) {
    Message message;
    if (receive(sockets_->socket, message, zmq::recv_flags::none)) return message;
    return std::nullopt;
  }
  if (auto message = take()) return message;
  const auto left = std::max(duration_cast<nanoseconds>(*until - steady_clock::now()), nanoseconds(1)).count();
  const itimerspec alarm{{0, 0}, {left / 1'000'000'000, left % 1'000'000'000}};
  timerfd_settime(sockets_->alarm, 0, &alarm, nullptr);
  while (steady_clock::now() < *until) {
    zmq::pollitem_t items[] = {{sockets_->socket.handle(), 0, ZMQ_POLLIN, 0},
                               {nullptr, sockets_->alarm, ZMQ_POLLIN, 0}};
    if (zmq_poll(items, 2, -1) < 0) return std::nullopt;  // a signal
    if (auto message = take()) return message;
  }
  return std::nullopt;
}

std::optional<Router::Message> Router::take() {
  Message message;
  if (receive(sockets_->socket, message, zmq::recv_flags::dontwait)) return message;
  return std::nullopt;
}

bool Router::send(const std::string& to, std::string_view text) {
  try {
    // A tool that asks and never reads loses answers, nobody else does.
    if (!sockets_->socket.send(zmq::buffer(to), zmq::send_flags::sndmore | zmq::send_flags::dontwait)) return false;
    return sockets_->socket.send(zmq::buffer(text), zmq::send_flags::dontwait).has_value();
  } catch (const zmq::error_t&) {  // EHOSTUNREACH: the peer is gone; the launcher states why
    return false;
  }
}

const std::string& Router::live_endpoint() const { return sockets_->live_endpoint; }

void Router::publish_live(const msg::Packet& packet) {
  sockets_->viewers.read(sockets_->live);
  if (sockets_->viewers.empty()) return;
  std::vector<zmq::message_t> frames = to_frames(packet);
  send_frames(sockets_->live, frames);
}

struct ClockQuery::Sockets {
  zmq::context_t context{1};
  zmq::socket_t socket{context, zmq::socket_type::dealer};
};

ClockQuery::ClockQuery(const std::string& clock_endpoint, const std::optional<Keys>& keys)
    : sockets_(std::make_unique<Sockets>()) {
  connect_control(sockets_->socket, clock_endpoint, keys);
  sockets_->socket.set(zmq::sockopt::linger, 0);
}
ClockQuery::~ClockQuery() = default;

std::optional<std::string> ClockQuery::ask(std::string_view request, std::chrono::milliseconds patience) {
  zmq::message_t late;  // an answer that nobody waited for any more
  while (sockets_->socket.recv(late, zmq::recv_flags::dontwait)) {
  }
  sockets_->socket.send(zmq::buffer(request));
  zmq::pollitem_t item{sockets_->socket.handle(), 0, ZMQ_POLLIN, 0};
  zmq::message_t answer;
  if (zmq::poll(&item, 1, patience) == 0 || !sockets_->socket.recv(answer, zmq::recv_flags::dontwait))
    return std::nullopt;
  return answer.to_string();
}

}  // namespace ensonify::bus
