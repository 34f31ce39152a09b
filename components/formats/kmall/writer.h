#pragma once

#include <cstdint>

#include "components/formats/kmall/datagram.h"

namespace ensonify::formats::kmall {

/// Appends a datagram in its frame, as it stands in a file: whole, of any length.
void append(Bytes& out, const Datagram& datagram);

/// Writes the datagrams of one system.
class Writer {
 public:
  explicit Writer(std::uint16_t sounder, std::uint8_t system = 40) : sounder_(sounder), system_(system) {}

  void append_body(Bytes& out, std::int64_t unix_ns, Body body) const;

 private:
  std::uint16_t sounder_;
  std::uint8_t system_;
};

}  // namespace ensonify::formats::kmall
