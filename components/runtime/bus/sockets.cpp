#include "components/runtime/bus/sockets.h"

#include "components/runtime/bus/frames.h"
#include "components/runtime/exit_error.h"

namespace ensonify::bus {

std::string bind(zmq::socket_t& socket, const Address& address, const std::string& name) {
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
  return bind(socket, address, process + ".live");
}

void send_live(zmq::socket_t& socket, std::vector<zmq::message_t>& frames) {
  zmq::message_t subscription;
  while (socket.recv(subscription, zmq::recv_flags::dontwait)) {  // lets ZeroMQ take note of new viewers
  }
  send_frames(socket, frames);
}

void connect_control(zmq::socket_t& dealer, const std::string& endpoint) {
  dealer.set(zmq::sockopt::linger, kLingerMs);
  dealer.set(zmq::sockopt::reconnect_ivl, kReconnectMs);
  dealer.set(zmq::sockopt::sndhwm, 0);
  dealer.set(zmq::sockopt::rcvhwm, 0);
  dealer.connect(endpoint);
}

}  // namespace ensonify::bus
