#include "components/runtime/bus/sockets.h"

#include <algorithm>

#include "components/errors/exit_error.h"

namespace ensonify::bus {

std::string bind_to(zmq::socket_t& socket, const Address& address, const std::string& name) {
  constexpr std::size_t kLongestSocketPath = 107;
  const std::string path = address.run_dir + "/" + name;
  if (!address.tcp && path.size() > kLongestSocketPath) {
    throw UserError(path + ": a socket path has at most 107 bytes; use a shorter run directory or process name");
  }
  const std::string tcp = address.tcp_bind.empty() ? "tcp://127.0.0.1:*" : address.tcp_bind;
  if (address.tcp && !tcp.starts_with("tcp://127.0.0.1:")) {
    throw UserError(tcp + ": only tcp://127.0.0.1 is allowed; other interfaces need keys, which are not supported yet");
  }
  try {
    socket.bind(address.tcp ? tcp : "ipc://" + path);
  } catch (const zmq::error_t& e) {
    throw UserError((address.tcp ? tcp : path) + ": cannot bind: " + e.what());
  }
  return socket.get(zmq::sockopt::last_endpoint);
}

std::string bind_live(zmq::socket_t& socket, const Address& address, const std::string& process) {
  constexpr int kLiveQueue = 4;
  socket.set(zmq::sockopt::sndhwm, kLiveQueue);
  socket.set(zmq::sockopt::linger, 0);
  return bind_to(socket, address, process + ".live");
}

std::vector<std::string> Subscribers::read(zmq::socket_t& xpub) {
  constexpr char kSubscribe = 1;  // ZeroMQ's first byte; 0 takes it back when the last subscriber of it has gone
  std::vector<std::string> fresh;
  zmq::message_t message;
  while (xpub.recv(message, zmq::recv_flags::dontwait)) {
    const std::string_view text = message.to_string_view();
    if (text.empty()) continue;
    if (text[0] != kSubscribe) prefixes_.erase(std::string(text.substr(1)));
    else if (prefixes_.emplace(text.substr(1)).second) fresh.emplace_back(text.substr(1));
  }
  return fresh;
}

bool Subscribers::has_subscriber(const std::string& topic) const {
  const std::string_view frame(topic.c_str(), topic.size() + 1);
  return std::any_of(prefixes_.begin(), prefixes_.end(),
                     [&](const std::string& prefix) { return frame.starts_with(prefix); });
}

void connect_control(zmq::socket_t& dealer, const std::string& endpoint) {
  dealer.set(zmq::sockopt::linger, kLingerMs);
  dealer.set(zmq::sockopt::reconnect_ivl, kReconnectMs);
  dealer.set(zmq::sockopt::sndhwm, 0);
  dealer.set(zmq::sockopt::rcvhwm, 0);
  dealer.connect(endpoint);
}

}  // namespace ensonify::bus
