#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "kernels/terrain/tile.h"
#include "messages/terrain.h"

namespace ensonify::pager {

/// Tiles in memory, made ahead of need by threads of its own. What a tile holds does not depend on when it was made or
/// by whom; only how long take() waits does. The one structure of the pager that threads share.
class TileStore {
 public:
  using TilePtr = std::shared_ptr<const msg::Tile>;
  using Make = std::function<TilePtr(const terrain::TileKey&)>;

  TileStore(Make make, int threads);
  ~TileStore();
  TileStore(const TileStore&) = delete;
  TileStore& operator=(const TileStore&) = delete;

  /// Makes these in the background, in this order, and forgets all others.
  void want(const std::vector<terrain::TileKey>& keys);

  struct Taken {
    TilePtr tile;
    bool late = false;  // it was not ready, so the caller waited for it
  };
  /// The tile, made now if need be. Throws what making it threw.
  Taken take(const terrain::TileKey& key);

 private:
  enum class State { kQueued, kBeingMade, kReady };
  struct Slot {
    State state = State::kQueued;
    TilePtr tile;
    std::exception_ptr error;
  };
  using SlotPtr = std::shared_ptr<Slot>;

  void work();
  void make_now(const terrain::TileKey& key, const SlotPtr& slot, std::unique_lock<std::mutex>& lock);

  Make make_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<terrain::TileKey, SlotPtr> slots_;
  std::deque<terrain::TileKey> queue_;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace ensonify::pager
