#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/feeds/sources.h"
#include "components/runtime/ports.h"
#include "messages/feed.h"

namespace ensonify {

/// What a process takes from outside. It publishes that as `data`; in place of the sources another run's `data` may be
/// its input, which then drives it to the same bytes.
class FeedInput {
 public:
  /// Takes at `rate` at most.
  FeedInput(Ports& ports, std::vector<ByteSource> sources, bool recorded, Rate rate);

  /// At the first event, not before: a check of the launch file takes no port.
  void open();
  /// What came since the event before.
  std::vector<FedPiece> take(SimTime now);
  /// What is wrong with the sources; "": nothing.
  std::string trouble() const { return open_ ? open_->trouble() : ""; }

 private:
  Ports& ports_;
  std::vector<ByteSource> sources_;
  std::optional<Sources> open_;
  std::vector<FedPiece> recorded_;                 // for this event
  std::optional<Ports::Out<msg::FeedData>> data_;  // not there: a record takes the sources' place
};

}  // namespace ensonify
