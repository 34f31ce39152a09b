#pragma once

#include <cstdint>
#include <variant>

#include "components/formats/raw.h"
#include "components/formats/xtf/bathymetry.h"
#include "components/formats/xtf/navigation.h"
#include "components/formats/xtf/ping.h"

namespace ensonify::formats::xtf {

/// What a packet begins with, after its magic number and before its length.
struct PacketHeader {
  std::uint8_t type = 0;
  std::uint8_t sub_channel = 0;
  std::uint16_t channels = 0;  // of a ping: how many follow
  std::array<std::uint8_t, 4> spare{};

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.type, self.sub_channel, self.channels, self.spare);
  }
  bool operator==(const PacketHeader&) const = default;
};

using Body = std::variant<Raw, SonarPing, MultibeamPing, MultiTransmitPing, Attitude, RawNavigation, Notes, RawSerial>;

struct Packet {
  std::uint64_t offset = 0;  // in its file
  PacketHeader header;
  Body body;
  Bytes rest;          // behind what the layout knows, but for the padding
  bool padded = true;  // with zeros, to a multiple of 64 bytes

  std::optional<std::int64_t> unix_ns() const {
    return std::visit(
        []<class One>(const One& one) -> std::optional<std::int64_t> {
          if constexpr (std::is_same_v<One, Raw>) return std::nullopt;
          else if constexpr (requires { one.header; }) return one.header.unix_ns();
          else return one.unix_ns();
        },
        body);
  }
};

}  // namespace ensonify::formats::xtf
