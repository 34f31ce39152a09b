#pragma once

#include <vector>

#include "components/feeds/sources.h"
#include "messages/feed.h"

namespace ensonify {

/// What was taken at an event, as a message.
msg::FeedData feed_data(SimTime now, const std::vector<ByteSource>& sources, const std::vector<FedPiece>& pieces);

/// Bytes of the largest one.
std::size_t most_feed_bytes(const std::vector<ByteSource>& sources);

/// Appends the pieces of such a message. Those of sources that are not there are left out.
void append_pieces(const msg::FeedData& data, const std::vector<ByteSource>& sources, std::vector<FedPiece>& pieces);

}  // namespace ensonify
