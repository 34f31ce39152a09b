#pragma once

#include <vector>

#include "components/nav_feed/sources.h"
#include "messages/feed.h"

namespace ensonify {

/// What was taken at an event, as a message.
msg::FeedData feed_data(SimTime now, const std::vector<FeedSource>& sources, const std::vector<FedPiece>& pieces);

/// Bytes of the largest one.
std::size_t most_feed_bytes(const std::vector<FeedSource>& sources);

/// Appends the pieces of such a message. Those of sources that are not there are left out.
void append_pieces(const msg::FeedData& data, const std::vector<FeedSource>& sources, std::vector<FedPiece>& pieces);

}  // namespace ensonify
