#include "components/runtime/bus/sockets.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "components/errors/exit_error.h"
#include "components/runtime/bus/gate.h"

namespace ensonify::bus {

std::string bind_to(zmq::socket_t& socket, const Address& address, const std::string& name) {
  constexpr std::size_t kLongestSocketPath = 107;
  const std::string path = address.run_dir + "/" + name;
  if (!address.tcp && path.size() > kLongestSocketPath) {
    throw UserError(path + ": a socket path has at most 107 bytes; use a shorter run directory or process name");
  }
  const std::string tcp = "tcp://" + address.host + ":" + (address.port == 0 ? "*" : std::to_string(address.port));
  if (address.tcp && !address.keys && !address.host.starts_with("127.")) {
    throw UserError(tcp + ": only 127.0.0.1 is allowed without keys");
  }
  if (address.tcp && address.keys) set_bound(socket, *address.keys);
  try {
    socket.bind(address.tcp ? tcp : "ipc://" + path);
  } catch (const zmq::error_t& e) {
    throw UserError((address.tcp ? tcp : path) + ": cannot bind: " + e.what());
  }
  return socket.get(zmq::sockopt::last_endpoint);
}

std::string host_towards(const std::string& endpoint) {
  const std::size_t start = std::strlen("tcp://"), colon = endpoint.rfind(':');
  sockaddr_in there{}, here{};
  there.sin_family = AF_INET;
  there.sin_port = htons(9);  // any: nothing is sent
  const bool is_address = endpoint.starts_with("tcp://") && colon > start &&
                          ::inet_pton(AF_INET, endpoint.substr(start, colon - start).c_str(), &there.sin_addr) == 1;
  if (!is_address) throw UserError(endpoint + ": is no clock; ipc://... and tcp://ADDRESS:PORT are");
  const int probe = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  socklen_t size = sizeof here;
  const bool known = ::connect(probe, reinterpret_cast<const sockaddr*>(&there), sizeof there) == 0 &&
                     ::getsockname(probe, reinterpret_cast<sockaddr*>(&here), &size) == 0;
  const std::string cause = std::strerror(errno);
  if (probe >= 0) ::close(probe);
  if (!known) throw UserError(endpoint + ": cannot be reached from here: " + cause);
  char text[INET_ADDRSTRLEN] = "";
  ::inet_ntop(AF_INET, &here.sin_addr, text, sizeof text);
  return text;
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

void connect_control(zmq::socket_t& dealer, const std::string& endpoint, const std::optional<Keys>& keys) {
  if (keys) set_connected(dealer, *keys);
  dealer.set(zmq::sockopt::linger, kLingerMs);
  dealer.set(zmq::sockopt::reconnect_ivl, kReconnectMs);
  dealer.set(zmq::sockopt::sndhwm, 0);
  dealer.set(zmq::sockopt::rcvhwm, 0);
  dealer.connect(endpoint);
}

namespace {

constexpr std::size_t kCopyBelow = 4096;  // a copy is cheaper than an owner

zmq::message_t frame_of(const msg::Buffer& buffer) {
  if (buffer.size < kCopyBelow) return zmq::message_t(buffer.data, buffer.size);
  auto* owner = new std::shared_ptr<const void>(buffer.owner);
  const auto release = [](void*, void* hint) { delete static_cast<std::shared_ptr<const void>*>(hint); };
  return zmq::message_t(const_cast<std::byte*>(buffer.data), buffer.size, release, owner);
}

msg::Buffer buffer_of(zmq::message_t&& frame) {
  auto kept = std::make_shared<zmq::message_t>(std::move(frame));
  const auto* data = static_cast<const std::byte*>(kept->data());
  const std::size_t size = kept->size();
  return {std::move(kept), data, size};
}

}  // namespace

std::vector<zmq::message_t> to_frames(const msg::Packet& packet) {
  std::vector<zmq::message_t> frames;
  frames.reserve(packet.envelope.frame_count);
  frames.emplace_back(packet.topic.c_str(), packet.topic.size() + 1);  // the NUL ends the topic
  const auto envelope = msg::encode_envelope(packet.envelope);
  frames.emplace_back(envelope.data(), envelope.size());
  frames.push_back(frame_of(packet.body.map));
  for (const msg::Buffer& array : packet.body.arrays) frames.push_back(frame_of(array));
  if (packet.wall_facts.size > 0) frames.push_back(frame_of(packet.wall_facts));
  return frames;
}

bool receive_frames(zmq::socket_t& socket, std::vector<zmq::message_t>& frames, bool wait) {
  frames.clear();
  while (true) {
    zmq::message_t& frame = frames.emplace_back();
    const bool first = frames.size() == 1;
    if (!socket.recv(frame, wait || !first ? zmq::recv_flags::none : zmq::recv_flags::dontwait)) return false;
    if (!frame.more()) return true;
  }
}

msg::Packet to_packet(std::vector<zmq::message_t>&& frames) {
  if (frames.size() < msg::kFirstArrayFrame) throw msg::DecodeError("message: fewer than 3 frames");
  msg::Packet packet;
  packet.envelope = msg::decode_envelope({static_cast<const std::byte*>(frames[1].data()), frames[1].size()});
  if (packet.envelope.frame_count != frames.size()) throw msg::DecodeError("envelope: frame count does not match");
  const char* topic = frames[0].data<char>();
  if (frames[0].size() == 0 || topic[frames[0].size() - 1] != '\0') throw msg::DecodeError("topic: no NUL at its end");
  packet.topic.assign(topic, frames[0].size() - 1);
  packet.body.map = buffer_of(std::move(frames[2]));
  std::size_t end = frames.size();
  if ((packet.envelope.flags & msg::kFlagWallFacts) != 0 && end > msg::kFirstArrayFrame) {
    packet.wall_facts = buffer_of(std::move(frames[--end]));
  }
  for (std::size_t i = msg::kFirstArrayFrame; i < end; ++i)
    packet.body.arrays.push_back(buffer_of(std::move(frames[i])));
  return packet;
}

void send_frames(zmq::socket_t& socket, std::vector<zmq::message_t>& frames) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    zmq::message_t shared;
    shared.copy(frames[i]);
    socket.send(shared, i + 1 < frames.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
  }
}

}  // namespace ensonify::bus
