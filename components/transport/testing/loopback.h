#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "components/transport/descriptor.h"
#include "components/transport/receiver.h"
#include "components/transport/socket_address.h"

/// What tests of both ways share.
namespace ensonify {

/// A port of this machine that nobody has.
inline int free_port(int type) {
  const Descriptor probe(::socket(AF_INET, type, 0));
  const SocketAddress own(host_address("127.0.0.1"));
  if (::bind(probe.get(), own.data(), own.size()) != 0) return 0;
  SocketAddress given;
  ::getsockname(probe.get(), given.data(), given.size_given());
  return given.address().port;
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
