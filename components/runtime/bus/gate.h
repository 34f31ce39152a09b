#pragma once

#include <functional>
#include <thread>
#include <zmq.hpp>

#include "components/runtime/bus/keys.h"

namespace ensonify::bus {

/// Decides who may connect to what a context has bound (ZAP, RFC 27): holders of the run's key at an allowed address.
/// A thread of its own answers ZeroMQ's question before the peer's first byte is passed on.
class Gate {
 public:
  /// Made before the context's sockets are bound; goes before the context ends. `refused` is called from the thread
  /// with the address of who was turned away and why.
  using Refused = std::function<void(const std::string& address, const std::string& why)>;
  Gate(zmq::context_t& context, const Keys& keys, Refused refused = {});
  ~Gate();
  Gate(const Gate&) = delete;
  Gate& operator=(const Gate&) = delete;

 private:
  void answer(zmq::socket_t& socket);

  std::string key_;  // 32 bytes
  AddressList allowed_;
  Refused refused_;
  zmq::socket_t end_;
  std::thread thread_;
};

/// Options of a socket before it is bound, or connected.
void set_bound(zmq::socket_t& socket, const Keys& keys);
void set_connected(zmq::socket_t& socket, const Keys& keys);

}  // namespace ensonify::bus
