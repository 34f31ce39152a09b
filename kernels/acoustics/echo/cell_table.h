#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "kernels/acoustics/echo/cell_lattice.h"

namespace ensonify::echo {

/// From cells to numbers: a table with open addressing. A look-up misses the cache: so ask for the slots of many
/// cells first, have them fetched, and look then.
class CellTable {
 public:
  /// Forgets all cells. Nothing is written for that, but every 255th time.
  void clear() {
    taken_ = 0;
    if (++round_ > kRounds) lines_.assign(lines_.size(), {}), round_ = 1;
  }

  /// Room for `more` cells. What cell_of says of a number is its cell.
  template <class CellOf>
  void make_room(std::size_t more, const CellOf& cell_of) {
    while (2 * (taken_ + more) > size_) grow(cell_of);
  }

  /// Where the search for a cell begins, until the next make_room(). Of a layer of a patch of 4 x 4 cells, whichever
  /// way it stands, all begin in different slots, two lines of the cache.
  std::size_t slot(std::uint64_t cell) const {
    constexpr std::uint64_t kPatches =
        ~(std::uint64_t{3} | (std::uint64_t{3} << kCellBits) | (std::uint64_t{3} << (2 * kCellBits)));
    const std::uint64_t up = cell >> (2 * kCellBits);
    const std::uint64_t in_patch = ((cell + up) & 3) | (((cell >> kCellBits) + up) & 3) << 2;
    return (((spread(cell & kPatches) >> 36) * kPatch) & (size_ - 1)) | in_patch;
  }
  void fetch(std::size_t slot) const { __builtin_prefetch(&at(slot), 1); }

  /// The number that stands there, of this cell or of any other.
  std::uint32_t guess(std::size_t slot) const { return at(slot).number; }

  /// The number of a cell whose search begins there; `next` becomes its number if it has none.
  template <class CellOf>
  std::uint32_t number(std::uint64_t cell, std::size_t slot, std::uint32_t next, const CellOf& cell_of) {
    const std::uint32_t mark = mark_of(cell);
    for (std::size_t tries = 1;; slot = after(slot, tries++)) {
      const Slot& here = at(slot);
      if (here.mark == mark && cell_of(here.number) == cell) return here.number;
      if ((here.mark & kRounds) != round_) break;
    }
    at(slot) = {mark, next};
    ++taken_;
    return next;
  }

 private:
  struct Slot {
    std::uint32_t mark, number;  // the round in which it was taken, and 24 bits of its cell's hash above it
  };
  static constexpr std::uint32_t kRounds = 255;
  static constexpr std::size_t kPatch = 16, kLeast = 1024, kLine = 8;
  struct alignas(64) Line : std::array<Slot, kLine> {};  // of the cache
  Slot& at(std::size_t slot) { return lines_[slot / kLine][slot % kLine]; }
  const Slot& at(std::size_t slot) const { return lines_[slot / kLine][slot % kLine]; }

  /// The top bits are well mixed.
  static std::uint64_t spread(std::uint64_t cell) { return cell * 0x9e3779b97f4a7c15ULL; }
  std::uint32_t mark_of(std::uint64_t cell) const {
    return static_cast<std::uint32_t>(spread(cell) >> 40) << 8 | round_;
  }
  /// The next slot after so many: first all of a line of the cache, which is here already, then the next line.
  std::size_t after(std::size_t slot, std::size_t tries) const {
    const std::size_t line = slot & ~(kLine - 1), in_line = (slot + 1) & (kLine - 1);
    return tries % kLine != 0 ? line | in_line : ((line + kLine) & (size_ - 1)) | in_line;
  }

  template <class CellOf>
  void grow(const CellOf& cell_of) {
    size_ = std::max(kLeast, 2 * size_);
    for (const Line& line : std::exchange(lines_, std::vector<Line>(size_ / kLine))) {
      for (const Slot& one : line) {
        if ((one.mark & kRounds) != round_) continue;
        std::size_t slot = this->slot(cell_of(one.number));
        for (std::size_t tries = 1; at(slot).mark != 0; ++tries) slot = after(slot, tries);
        at(slot) = one;
      }
    }
  }

  std::vector<Line> lines_;
  std::size_t size_ = 0;
  std::size_t taken_ = 0;
  std::uint32_t round_ = 1;  // 1 to kRounds; slots of others are free
};

}  // namespace ensonify::echo
