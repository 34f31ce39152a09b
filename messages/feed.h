#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "messages/array.h"

namespace ensonify::msg {

/// Bytes of one source of a feed that came together.
struct FeedPiece {
  std::string source;
  std::int64_t arrival_ns = 0;
  std::int64_t byte_count = 0;
  bool begins = false;
  bool whole = false;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("source", "", "name of the source that sent them", self.source);
    visit("arrival_ns", "ns", "time of their arrival, sim time", self.arrival_ns);
    visit("byte_count", "1", "number of bytes", self.byte_count);
    visit("begins", "", "true for the first of a connection", self.begins);
    visit("whole", "", "true for a datagram, which nothing continues", self.whole);
  }
};

/// What came from outside, as it was taken at one event.
struct FeedData {
  static constexpr const char* kType = "feed_data/1";
  static constexpr const char* kAbout = "Bytes from outside that a feed took at this event, as they came.";
  std::int64_t stamp_ns = 0;
  std::vector<FeedPiece> pieces;
  Array<std::uint8_t> bytes;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of the event, sim time", self.stamp_ns);
    visit("pieces", "", "pieces in the order in which they were taken", self.pieces);
    visit("bytes", "1", "bytes of all pieces, one after the other", self.bytes);
  }
};

}  // namespace ensonify::msg
