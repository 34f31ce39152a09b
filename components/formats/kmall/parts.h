#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "components/formats/bytes.h"

/// On a network a datagram of a ping is cut into parts. Each has the header of the whole with a length of its own, the
/// number of parts and its own from 1 on, a piece of the body, and that length again.
namespace ensonify::formats::kmall {

/// The longest part, as instruments cut them.
inline constexpr std::size_t kMostPartBytes = 64'000;

/// Bytes of the datagram at the front of a file's bytes, by its length. The bytes are our own.
std::size_t datagram_bytes(ByteView file);

/// A datagram of a file as the network carries it: #MRZ and #MWC in parts of at most kMostPartBytes, others as they
/// are.
std::vector<Bytes> parts_of(ByteView datagram);

/// Joins what came of a network to the datagrams of a file.
///
/// Parts of one datagram have its type and header, and come in any order. One that came already, byte for byte, is
/// dropped. Another with the number of one that is there begins the next datagram of that time (two heads share it),
/// and the one before is given up. So is the oldest of more than kMostOpen that lack parts. What is no whole frame, or
/// has a number that cannot be, is dropped.
class PartJoiner {
 public:
  static constexpr std::size_t kMostOpen = 8;
  static constexpr std::uint16_t kMostParts = 1'100;  // of the longest datagram that a file has

  struct Counts {
    std::int64_t whole = 0;       // datagrams given
    std::int64_t incomplete = 0;  // given up
    std::int64_t doubled = 0;     // parts that came already
    std::int64_t refused = 0;     // no parts of a datagram
  };

  /// The datagram that this completes, as a file has it.
  std::optional<Bytes> take(ByteView received);
  /// Gives up what lacks parts.
  void finish();
  const Counts& counts() const { return counts_; }

 private:
  using Head = std::array<std::byte, 16>;  // without its length

  struct Open {
    Head head{};
    std::vector<Bytes> parts;  // as they came; empty: not yet
    std::size_t missing = 0;
  };

  static Head head_of(ByteView received);
  bool has(const Open& open, std::size_t part, ByteView received) const;
  Bytes joined(const Open& open) const;

  std::deque<Open> open_;     // the oldest first
  std::optional<Open> last_;  // completed
  Counts counts_;
};

}  // namespace ensonify::formats::kmall
