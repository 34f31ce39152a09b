#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "components/transport/descriptor.h"
#include "components/transport/receiver.h"

/// What tests of both ways share.
namespace ensonify {

/// A port of this machine that nobody has.
inline int free_port(int type) {
  const Descriptor probe(::socket(AF_INET, type, 0));
  sockaddr_in own = ipv4("127.0.0.1", 0);
  socklen_t length = sizeof own;
  if (::bind(probe.get(), reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0) return 0;
  ::getsockname(probe.get(), reinterpret_cast<sockaddr*>(&own), &length);
  return ntohs(own.sin_port);
}

/// Asks until it holds, for five seconds at most.
inline bool comes_true(const std::function<bool()>& holds) {
  for (int i = 0; i < 500; ++i) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// All bytes, once there are so many.
inline std::string received(Receiver& receiver, std::size_t count) {
  std::string bytes;
  comes_true([&] {
    while (auto arrival = receiver.take()) bytes += arrival->piece.bytes;
    return bytes.size() >= count;
  });
  return bytes;
}

}  // namespace ensonify
