#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/base/frames/attitude.h"

namespace ensonify::boresight {

/// A sounding by its line and its number in it.
struct SoundingRef {
  std::uint32_t line = 0;
  std::uint32_t index = 0;
};

/// Cell with soundings of at least two lines: `members` holds the soundings, line by line.
struct Cell {
  std::span<const SoundingRef> members;
};

/// The squares of `side_m` on the ground in which at least two lines have `least` soundings or more, from the
/// south-west on, row by row; lines with fewer are left out of a cell. A corner of the squares lies at `corner_m`
/// (east, north). The order depends on the soundings alone.
class Cells {
 public:
  Cells(const std::vector<std::vector<frames::Vec3>>& places_enu_m, double side_m, std::size_t least,
        const frames::Vec2& corner_m);

  std::size_t size() const { return starts_.empty() ? 0 : starts_.size() - 1; }
  Cell operator[](std::size_t n) const {
    return {std::span(members_).subspan(starts_[n], starts_[n + 1] - starts_[n])};
  }

 private:
  std::vector<SoundingRef> members_;
  std::vector<std::size_t> starts_;
};

}  // namespace ensonify::boresight
