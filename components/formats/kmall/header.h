#pragma once

#include <array>
#include <cstdint>

#include "components/formats/layout.h"

/// Kongsberg's .kmall, EMdgmFormat revision I, of which all field lists of this folder are.
namespace ensonify::formats::kmall {

/// What every datagram begins with, after its length and type.
struct Header {
  std::uint8_t version = 0;  // of the datagram's layout
  std::uint8_t system = 0;
  std::uint16_t sounder = 0;  // 2040: an EM 2040
  std::uint32_t time_s = 0;   // since 1970
  std::uint32_t time_ns = 0;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.version, self.system, self.sounder, self.time_s, self.time_ns);
  }
  bool operator==(const Header&) const = default;
};

/// Parts of a datagram that was cut for the network; 1 of 1 in a file.
struct Partition {
  std::uint16_t parts = 1;
  std::uint16_t part = 1;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.parts, self.part);
  }
  bool operator==(const Partition&) const = default;
};

/// What datagrams of a sensor begin with.
struct SensorPart {
  std::uint16_t sensor = 0;  // of several: which
  std::uint16_t status = 0;  // bit 0: active
  std::uint16_t padding = 0;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire.constant(std::uint16_t{8});
    wire(self.sensor, self.status, self.padding);
  }
  bool operator==(const SensorPart&) const = default;
};

/// What datagrams of a ping begin with.
struct PingPart {
  std::uint16_t ping = 0;  // counts, modulo 65536
  std::uint8_t fans_per_ping = 1;
  std::uint8_t fan = 0;  // which of them, from 0: the head
  std::uint8_t swaths_per_ping = 1;
  std::uint8_t swath = 0;
  std::uint8_t transmitter = 0;
  std::uint8_t receiver = 0;
  std::uint8_t receivers = 1;
  std::uint8_t algorithm = 0;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire.constant(std::uint16_t{12});
    wire(self.ping, self.fans_per_ping, self.fan, self.swaths_per_ping, self.swath, self.transmitter, self.receiver,
         self.receivers, self.algorithm);
  }
  bool operator==(const PingPart&) const = default;
};

}  // namespace ensonify::formats::kmall
