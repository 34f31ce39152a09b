#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "kernels/acoustics/echo/cell_lattice.h"

namespace ensonify::echo {

/// From cells to numbers. Those of a patch, 4 x 4 cells of one layer, have a row, which is one line of the cache. A
/// table with open addressing finds rows. A look-up misses the cache: so ask for the slots of many cells first, have
/// them fetched, find their rows then, and their numbers last.
class CellTable {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  /// Forgets all cells. Nothing is written for that, but every 255th time.
  void clear() {
    taken_ = 0;
    if (++round_ == 0) slots_.assign(slots_.size(), {}), round_ = 1;
  }

  /// Room for the patches of `more` cells.
  void make_room(std::size_t more) {
    while (kSlotsPerPatch * (taken_ + more) > slots_.size()) grow();
    if (rows_.size() < taken_ + more) rows_.resize(2 * (taken_ + more));
  }

  /// Where the search for the row of a cell begins, until the next make_room().
  std::uint32_t slot(std::uint64_t cell) const { return slot_of_patch(cell & ~kInPatch); }
  void fetch(std::uint32_t slot) const { __builtin_prefetch(&slots_[slot], 1); }

  /// The row of a cell's patch, whose search begins there.
  std::uint32_t row(std::uint64_t cell, std::uint32_t slot) {
    const std::uint64_t patch = cell & ~kInPatch;
    for (;; slot = after(slot)) {
      const Slot& here = slots_[slot];
      if (here.round != round_) break;
      if (here.patch == patch) return here.row;
    }
    slots_[slot] = {patch, taken_, round_};
    rows_[taken_].fill(kNone);
    return taken_++;
  }

  /// The number of a cell of that row: kNone until one is put there.
  std::uint32_t& number(std::uint64_t cell, std::uint32_t row) {
    return rows_[row][(cell & 3) | ((cell >> kCellBits) & 3) << 2];
  }

 private:
  static constexpr std::uint64_t kInPatch = std::uint64_t{3} | (std::uint64_t{3} << kCellBits);
  static constexpr std::size_t kSlotsPerPatch = 4, kLeast = 1024;
  struct Slot {
    std::uint64_t patch;
    std::uint32_t row;
    std::uint8_t round;  // in which it was taken
  };
  struct alignas(64) Row : std::array<std::uint32_t, 16> {};

  /// The top bits are well mixed.
  std::uint32_t slot_of_patch(std::uint64_t patch) const {
    return static_cast<std::uint32_t>((patch * 0x9e3779b97f4a7c15ULL) >> shift_);
  }
  std::uint32_t after(std::uint32_t slot) const { return (slot + 1) & static_cast<std::uint32_t>(slots_.size() - 1); }

  void grow() {
    const std::size_t size = std::max(kLeast, 2 * slots_.size());
    shift_ = 64 - std::countr_zero(size);
    for (const Slot& one : std::exchange(slots_, std::vector<Slot>(size))) {
      if (one.round != round_) continue;
      std::uint32_t slot = slot_of_patch(one.patch);
      while (slots_[slot].round == round_) slot = after(slot);
      slots_[slot] = one;
    }
  }

  std::vector<Slot> slots_;  // a power of two
  std::vector<Row> rows_;
  std::uint32_t taken_ = 0;  // rows
  int shift_ = 0;
  std::uint8_t round_ = 1;  // above 0; slots of others are free
};

}  // namespace ensonify::echo
