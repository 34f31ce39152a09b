#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "kernels/mesh/tile.h"
#include "messages/terrain.h"

namespace ensonify::pager {

/// Tiles in memory, never more than `most`, made ahead of need by threads of its own. What a tile holds does not depend
/// on when it was made or by whom; only how long take() waits does. The one structure of the pager that threads share;
/// hold() and take() belong to one of them.
class TileStore {
 public:
  using TilePtr = std::shared_ptr<const msg::Tile>;
  using Tiles = std::map<terrain::TileKey, TilePtr>;
  using Make = std::function<TilePtr(const terrain::TileKey&)>;
  struct Limits {
    int threads = 2;
    std::size_t most = 100;  // tiles, those being made among them; more than threads
  };

  /// `at_hand` have been made before; what hold() does not ask for is forgotten.
  TileStore(Make make, const Limits& limits, const Tiles& at_hand = {});
  ~TileStore();
  TileStore(const TileStore&) = delete;
  TileStore& operator=(const TileStore&) = delete;

  /// Makes these in the background and forgets all others. In order of importance, at most `most`: the first are made
  /// first, the last make room for a tile that is taken and not among them.
  void hold(const std::vector<terrain::TileKey>& keys);

  /// Those that are in memory and made.
  Tiles ready() const;

  struct Taken {
    TilePtr tile;
    bool late = false;  // it was not ready, so the caller waited for it
  };
  /// The tile, made now if need be. Throws what making it threw.
  Taken take(const terrain::TileKey& key);

  /// Facts of wall time: how fast disk and threads are, never what the run computes.
  struct Statistics {
    std::size_t resident = 0;       // tiles in memory, those being made among them
    std::size_t most_resident = 0;  // at any time
    std::int64_t made = 0;
    std::int64_t taken = 0;
    std::int64_t late = 0;
    double least_margin_s =
        std::numeric_limits<double>::infinity();  // from ready to taken; of a late one minus its wait
  };
  Statistics statistics() const;

 private:
  using Clock = std::chrono::steady_clock;
  enum class State { kQueued, kBeingMade, kReady };
  struct Slot {
    State state = State::kQueued;
    bool wanted = true;    // else it is forgotten as soon as it is made
    std::size_t rank = 0;  // place in the order of importance
    TilePtr tile;
    std::exception_ptr error;
    Clock::time_point ready{};
  };
  using SlotPtr = std::shared_ptr<Slot>;

  void work();
  void make_now(const terrain::TileKey& key, const SlotPtr& slot, std::unique_lock<std::mutex>& lock);
  void make_room(const SlotPtr& slot, std::unique_lock<std::mutex>& lock);

  Make make_;
  Limits limits_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<terrain::TileKey, SlotPtr> slots_;
  std::deque<terrain::TileKey> queue_;
  Statistics statistics_;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace ensonify::pager
