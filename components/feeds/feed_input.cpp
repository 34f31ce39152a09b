#include "components/feeds/feed_input.h"

#include <utility>

#include "components/feeds/feed_message.h"

namespace ensonify {

FeedInput::FeedInput(Ports& ports, std::vector<ByteSource> sources, bool recorded, Rate rate)
    : ports_(ports), sources_(std::move(sources)) {
  if (recorded) {
    ports.in<msg::FeedData>("data", [this](const msg::FeedData& data) { append_pieces(data, sources_, recorded_); });
  } else {
    data_.emplace(ports.out<msg::FeedData>("data", {.max_bytes = most_feed_bytes(sources_), .rate = rate}));
  }
}

void FeedInput::open() {
  if (data_ && !open_) open_.emplace(sources_);
}

std::vector<FedPiece> FeedInput::take(SimTime now) {
  if (!data_) return std::exchange(recorded_, {});
  open();
  std::vector<FedPiece> pieces = open_->take(now);
  open_->count([this](const std::string& what, std::int64_t by) { ports_.count(what, by); });
  if (!pieces.empty()) data_->send(feed_data(now, sources_, pieces));
  return pieces;
}

}  // namespace ensonify
