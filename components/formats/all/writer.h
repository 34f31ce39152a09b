#pragma once

#include <array>
#include <cstdint>

#include "components/formats/all/datagram.h"

namespace ensonify::formats::all {

/// Appends a datagram in its frame: length, marks, checksum, padding.
void append(Bytes& out, const Datagram& datagram);

/// Writes the datagrams of one system: gives them its model, serial and counters.
class Writer {
 public:
  Writer(std::uint16_t model, std::uint16_t serial) : model_(model), serial_(serial) {}

  /// A datagram of a ping: N, X, Y and k of one ping and head have its number and serial.
  void append_ping(Bytes& out, std::int64_t unix_ns, std::uint16_t ping, std::uint16_t head_serial, Body body) const;
  /// Any other, counted by its type.
  void append_next(Bytes& out, std::int64_t unix_ns, Body body);
  /// The closing 'i'.
  void append_close(Bytes& out, std::int64_t unix_ns, Installation installation);

 private:
  Datagram datagram(std::int64_t unix_ns, char type, std::uint16_t counter, std::uint16_t serial, Body body) const;

  std::uint16_t model_;
  std::uint16_t serial_;
  std::array<std::uint16_t, 256> counters_{};  // by type
};

}  // namespace ensonify::formats::all
