#include "components/terrain_pager/tile_store.h"

namespace ensonify::pager {

using terrain::TileKey;

TileStore::TileStore(Make make, int threads) : make_(std::move(make)) {
  for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

TileStore::~TileStore() {
  {
    const std::scoped_lock lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  for (auto& thread : threads_) thread.join();
}

void TileStore::want(const std::vector<TileKey>& keys) {
  {
    const std::scoped_lock lock(mutex_);
    std::map<TileKey, SlotPtr> wanted;
    queue_.clear();
    for (const TileKey& key : keys) {
      const auto known = slots_.find(key);
      const SlotPtr slot = known != slots_.end() ? known->second : std::make_shared<Slot>();
      wanted[key] = slot;
      if (slot->state == State::kQueued) queue_.push_back(key);
    }
    slots_ = std::move(wanted);
  }
  changed_.notify_all();
}

TileStore::Taken TileStore::take(const TileKey& key) {
  std::unique_lock lock(mutex_);
  SlotPtr& known = slots_[key];
  if (!known) known = std::make_shared<Slot>();
  const SlotPtr slot = known;
  const bool late = slot->state != State::kReady;
  if (slot->state == State::kQueued) make_now(key, slot, lock);
  changed_.wait(lock, [&] { return slot->state == State::kReady; });
  if (slot->error) std::rethrow_exception(slot->error);
  return {slot->tile, late};
}

void TileStore::make_now(const TileKey& key, const SlotPtr& slot, std::unique_lock<std::mutex>& lock) {
  slot->state = State::kBeingMade;
  lock.unlock();
  TilePtr tile;
  std::exception_ptr error;
  try {
    tile = make_(key);
  } catch (...) {
    error = std::current_exception();
  }
  lock.lock();
  slot->tile = std::move(tile);
  slot->error = error;
  slot->state = State::kReady;
  changed_.notify_all();
}

void TileStore::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return stopping_ || !queue_.empty(); });
    if (stopping_) return;
    const TileKey key = queue_.front();
    queue_.pop_front();
    const auto found = slots_.find(key);
    if (found == slots_.end() || found->second->state != State::kQueued) continue;  // released, or taken meanwhile
    const SlotPtr slot = found->second;
    make_now(key, slot, lock);
  }
}

}  // namespace ensonify::pager
