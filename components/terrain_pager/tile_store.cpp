#include "components/terrain_pager/tile_store.h"

#include <algorithm>
#include <utility>

#include "components/errors/assert.h"

namespace ensonify::pager {

using terrain::TileKey;

TileStore::TileStore(Make make, const Limits& limits, const Tiles& at_hand) : make_(std::move(make)), limits_(limits) {
  ENSONIFY_ASSERT(limits.threads >= 1 && limits.most > static_cast<std::size_t>(limits.threads),
                  std::to_string(limits.threads) + " threads, at most " + std::to_string(limits.most) + " tiles");
  for (const auto& [key, tile] : at_hand) {
    if (slots_.size() == limits.most) break;
    slots_[key] = std::make_shared<Slot>(Slot{.state = State::kReady, .tile = tile, .ready = Clock::now()});
  }
  statistics_.resident = statistics_.most_resident = slots_.size();
  for (int i = 0; i < limits.threads; ++i) threads_.emplace_back([this] { work(); });
}

TileStore::~TileStore() {
  {
    const std::scoped_lock lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  for (auto& thread : threads_) thread.join();
}

void TileStore::hold(const std::vector<TileKey>& keys) {
  ENSONIFY_ASSERT(keys.size() <= limits_.most, std::to_string(keys.size()) + " tiles");
  {
    const std::scoped_lock lock(mutex_);
    for (auto& [key, slot] : slots_) slot->wanted = false;
    queue_.clear();
    for (std::size_t i = 0; i < keys.size(); ++i) {
      SlotPtr& slot = slots_[keys[i]];
      if (!slot) slot = std::make_shared<Slot>();
      slot->wanted = true;
      slot->rank = i;
      if (slot->state == State::kQueued) queue_.push_back(keys[i]);
    }
    std::erase_if(slots_, [&](const auto& entry) {
      const Slot& slot = *entry.second;
      if (slot.wanted || slot.state == State::kBeingMade) return false;
      if (slot.state == State::kReady) --statistics_.resident;
      return true;
    });
  }
  changed_.notify_all();
}

TileStore::Tiles TileStore::ready() const {
  const std::scoped_lock lock(mutex_);
  Tiles tiles;
  for (const auto& [key, slot] : slots_) {
    if (slot->state == State::kReady && !slot->error) tiles[key] = slot->tile;
  }
  return tiles;
}

TileStore::Taken TileStore::take(const TileKey& key) {
  std::unique_lock lock(mutex_);
  SlotPtr& known = slots_[key];
  if (!known) known = std::make_shared<Slot>(Slot{.rank = limits_.most});
  const SlotPtr slot = known;
  slot->wanted = true;
  const auto asked = Clock::now();
  const bool late = slot->state != State::kReady;
  make_room(slot, lock);
  if (slot->state == State::kQueued) make_now(key, slot, lock);
  changed_.wait(lock, [&] { return slot->state == State::kReady; });
  const auto margin = late ? asked - Clock::now() : asked - slot->ready;
  statistics_.least_margin_s = std::min(statistics_.least_margin_s, std::chrono::duration<double>(margin).count());
  ++statistics_.taken;
  statistics_.late += late ? 1 : 0;
  if (slot->error) std::rethrow_exception(slot->error);
  return {slot->tile, late};
}

/// Returns when this tile may be made, the least important ones forgotten, or when somebody else makes it.
void TileStore::make_room(const SlotPtr& slot, std::unique_lock<std::mutex>& lock) {
  while (slot->state == State::kQueued && statistics_.resident >= limits_.most) {
    auto least = slots_.end();
    for (auto it = slots_.begin(); it != slots_.end(); ++it) {
      if (it->second->state != State::kReady) continue;
      if (least == slots_.end() || it->second->rank > least->second->rank) least = it;
    }
    if (least == slots_.end()) {
      changed_.wait(lock);
      continue;
    }
    slots_.erase(least);
    --statistics_.resident;
  }
}

void TileStore::make_now(const TileKey& key, const SlotPtr& slot, std::unique_lock<std::mutex>& lock) {
  slot->state = State::kBeingMade;
  ++statistics_.resident;
  statistics_.most_resident = std::max(statistics_.most_resident, statistics_.resident);
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
  slot->ready = Clock::now();
  ++statistics_.made;
  if (!slot->wanted) {
    slots_.erase(key);
    --statistics_.resident;
  }
  changed_.notify_all();
}

void TileStore::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return stopping_ || (!queue_.empty() && statistics_.resident < limits_.most); });
    if (stopping_) return;
    const TileKey key = queue_.front();
    queue_.pop_front();
    const auto found = slots_.find(key);
    if (found == slots_.end() || found->second->state != State::kQueued) continue;  // forgotten, or taken meanwhile
    const SlotPtr slot = found->second;
    make_now(key, slot, lock);
  }
}

TileStore::Statistics TileStore::statistics() const {
  const std::scoped_lock lock(mutex_);
  return statistics_;
}

}  // namespace ensonify::pager
