#include "components/feeds/feed_message.h"

#include <algorithm>
#include <cstring>

namespace ensonify {

msg::FeedData feed_data(SimTime now, const std::vector<ByteSource>& sources, const std::vector<FedPiece>& pieces) {
  msg::FeedData data;
  data.stamp_ns = now.count();
  std::vector<std::uint8_t> bytes;
  for (const FedPiece& piece : pieces) {
    data.pieces.push_back({sources[piece.source].name, piece.arrival.count(),
                           static_cast<std::int64_t>(piece.bytes.size()), piece.begins, piece.whole});
    bytes.insert(bytes.end(), piece.bytes.begin(), piece.bytes.end());
  }
  data.bytes = msg::Array<std::uint8_t>::of(std::move(bytes));
  return data;
}

std::size_t most_feed_bytes(const std::vector<ByteSource>& sources) {
  std::size_t of_a_piece = 96;  // its map, without the name
  for (const ByteSource& source : sources) of_a_piece = std::max(of_a_piece, 96 + source.name.size());
  const std::size_t pieces = Sources::kMostPieces + sources.size();
  return Sources::kMostBytes + sources.size() * Sources::kLargestPiece + pieces * of_a_piece + 1024;
}

void append_pieces(const msg::FeedData& data, const std::vector<ByteSource>& sources, std::vector<FedPiece>& pieces) {
  std::size_t at = 0;
  for (const msg::FeedPiece& piece : data.pieces) {
    const std::size_t left = data.bytes.size() - at;
    const std::size_t count = std::min(left, static_cast<std::size_t>(std::max<std::int64_t>(piece.byte_count, 0)));
    std::string bytes(count, '\0');
    if (count > 0) std::memcpy(bytes.data(), data.bytes.data() + at, count);
    at += count;
    const auto source = std::find_if(sources.begin(), sources.end(),
                                     [&](const ByteSource& known) { return known.name == piece.source; });
    if (source == sources.end()) continue;
    pieces.push_back({static_cast<std::size_t>(source - sources.begin()), SimTime{piece.arrival_ns}, std::move(bytes),
                      piece.begins, piece.whole});
  }
}

}  // namespace ensonify
