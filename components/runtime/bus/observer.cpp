#include "components/runtime/bus/observer.h"

#include <cstring>
#include <set>
#include <zmq.hpp>

#include "components/errors/exit_error.h"
#include "components/runtime/bus/gate.h"
#include "components/runtime/bus/sockets.h"

namespace ensonify::bus {

struct Observer::Sockets {
  zmq::context_t context{1};
  zmq::socket_t data{context, zmq::socket_type::sub};
  zmq::socket_t monitor{context, zmq::socket_type::pair};
  std::set<std::string> present;  // endpoints that are there, as far as we know

  /// A publisher binds before it says HELLO, so whoever cannot be reached has left.
  void note_leavers() {
    zmq::message_t event;
    zmq::message_t endpoint;
    while (monitor.recv(event, zmq::recv_flags::dontwait) && monitor.recv(endpoint, zmq::recv_flags::none)) {
      present.erase(endpoint.to_string());
    }
  }
};

Observer::Observer(const std::vector<Topic>& topics, const std::optional<Keys>& keys, int queue)
    : sockets_(std::make_unique<Sockets>()) {
  zmq::socket_t& data = sockets_->data;
  if (keys) set_connected(data, *keys);
  data.set(zmq::sockopt::rcvhwm, queue);
  data.set(zmq::sockopt::linger, 0);
  data.set(zmq::sockopt::reconnect_ivl, kReconnectMs);
  const std::string watch = "inproc://observer-monitor";
  if (zmq_socket_monitor(data.handle(), watch.c_str(), ZMQ_EVENT_DISCONNECTED | ZMQ_EVENT_CONNECT_RETRIED) == 0) {
    sockets_->monitor.connect(watch);
  }
  for (const Topic& topic : topics) data.set(zmq::sockopt::subscribe, topic.name + '\0');
  for (const Topic& topic : topics) {
    if (!sockets_->present.insert(topic.endpoint).second) continue;
    try {
      data.connect(topic.endpoint);
    } catch (const zmq::error_t& e) {
      throw UserError(topic.endpoint + ": cannot connect: " + e.what());
    }
  }
}

Observer::~Observer() { zmq_socket_monitor(sockets_->data.handle(), nullptr, 0); }

bool Observer::ended() const { return sockets_->present.empty(); }

std::optional<msg::Packet> Observer::next(std::optional<WallTime> until) {
  std::vector<zmq::message_t> frames;
  while (true) {
    if (receive_frames(sockets_->data, frames, false)) return to_packet(std::move(frames));
    if (ended()) return std::nullopt;
    long left_ms = -1;
    if (until) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(*until - std::chrono::steady_clock::now());
      if (left.count() <= 0) return std::nullopt;
      left_ms = left.count();
    }
    zmq::pollitem_t items[] = {{sockets_->data.handle(), 0, ZMQ_POLLIN, 0},
                               {sockets_->monitor.handle(), 0, ZMQ_POLLIN, 0}};
    if (zmq_poll(items, 2, left_ms) < 0) return std::nullopt;  // a signal: the caller checks why
    if (items[1].revents != 0) sockets_->note_leavers();
  }
}

}  // namespace ensonify::bus
