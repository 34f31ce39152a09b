#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "components/feeds/arrival_clock.h"
#include "components/feeds/byte_source.h"
#include "components/feeds/log_player.h"
#include "components/runtime/sim_time.h"
#include "components/transport/receiver.h"

namespace ensonify {

/// Bytes of one source as they are taken at an event.
struct FedPiece {
  std::size_t source = 0;
  SimTime arrival{0};
  std::string bytes;
  bool begins = false;  // Channel::Piece
  bool whole = false;
};

/// All sources of a feed: the ports and lines that are open, and the logs that are played. What has come since
/// the event before is taken in the order of its arrival, in sim time (ArrivalClock). What came while an event was late
/// is of the next one.
class Sources {
 public:
  /// Throws UserError, with the source's name, where one cannot be opened.
  explicit Sources(const std::vector<ByteSource>& sources);

  /// What has come by `now`, as much as an event may take: about kMostBytes and kMostPieces, in equal shares of the
  /// sources. The rest waits for the next one.
  std::vector<FedPiece> take(SimTime now);
  static constexpr std::size_t kMostBytes = 256U << 10U, kMostPieces = 2000, kLargestPiece = 65536;

  /// What is wrong with ports and lines, "gnss: no connection to 10.0.0.7:4001"; "": nothing.
  std::string trouble() const;
  /// Refused senders and dropped bytes since the last call, by counter.
  void count(const std::function<void(const std::string& what, std::int64_t by)>& count);

 private:
  struct Open {
    std::string name;
    std::variant<std::unique_ptr<Receiver>, std::unique_ptr<LogPlayer>> from;
    std::optional<Receiver::Arrival> waiting;      // for its event
    std::uint64_t refused = 0, dropped_bytes = 0;  // counted already
  };
  std::optional<Receiver::Arrival> take(Receiver& receiver, Open& open, SimTime now);

  std::vector<Open> open_;
  ArrivalClock clock_;
  SimTime last_{0};
};

}  // namespace ensonify
