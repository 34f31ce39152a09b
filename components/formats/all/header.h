#pragma once

#include <cstdint>

namespace ensonify::formats::all {

/// What every datagram of a .all file begins with, after its length and start mark. Kongsberg EM datagram formats,
/// 850-160692 rev. W, of which all field lists of this folder are.
struct Header {
  std::uint16_t model = 0;    // 710: an EM 710
  std::uint32_t date = 0;     // year * 10000 + month * 100 + day, UTC
  std::uint32_t time_ms = 0;  // since midnight
  std::uint16_t counter = 0;  // of the pings, or of the datagrams of this type
  std::uint16_t serial = 0;   // of the system; with two heads that of the head

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.model, self.date, self.time_ms, self.counter, self.serial);
  }
  bool operator==(const Header&) const = default;
};

}  // namespace ensonify::formats::all
