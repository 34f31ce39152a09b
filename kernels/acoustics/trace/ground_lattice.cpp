#include "kernels/acoustics/trace/ground_lattice.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "kernels/base/isa/wide.h"

namespace ensonify::trace {
namespace {

using frames::Vec2;

constexpr int kTurns = 12;  // of the axes, in half a circle

int level_of(double spacing_m) { return std::clamp(std::ilogb(spacing_m), -100, 100); }

}  // namespace

GroundLattice::GroundLattice(const Vec2& along_enu, double first_m, double second_m) {
  constexpr double kStep = std::numbers::pi / kTurns;
  const double turns = std::atan2(along_enu.y(), along_enu.x()) / kStep;
  const int turn = (static_cast<int>(std::lround(turns)) + 2 * kTurns) % kTurns;
  const int first = level_of(first_m), second = level_of(second_m);
  first_axis_ = {std::cos(turn * kStep), std::sin(turn * kStep)};
  first_m_ = std::ldexp(1.0, first);
  second_m_ = std::ldexp(1.0, second);
  places_per_block_ = std::clamp(4.0 * first_m_ * second_m_ / (first_m * second_m), 1.0, 4.0);
  name_ = static_cast<std::uint64_t>(((first + 128) << 12) | ((second + 128) << 4) | turn);
}

/// Each candidate of each block in columns, then those that there are, side by side: no branch for a place.
ENSONIFY_WIDE void GroundLattice::add_places(const random::Row& bits, const BlockRow& row, std::int64_t from,
                                             std::size_t blocks, LatticePlaces& to) const {
  alignas(64) std::array<std::array<std::uint64_t, kBlocks>, 2> words;  // two in each
  alignas(64) std::array<std::uint64_t, kBlocks> count, inside;
  alignas(64) std::array<double, kBlocks> share;
  alignas(64) std::array<std::array<double, kBlocks>, kMostPlaces> first_m, second_m;
  const auto number = [](std::uint64_t small) { return static_cast<double>(static_cast<std::int32_t>(small)); };
  const auto block_from = static_cast<double>(from), block_second = static_cast<double>(row.row);
  const auto inner = static_cast<std::int32_t>(row.inner - from),
             inner_end = static_cast<std::int32_t>(row.inner_end - from);
  for (std::size_t i = 0; i < blocks; ++i) {
    const auto drawn = bits.bits(static_cast<std::uint64_t>(from) + i);
    words[0][i] = drawn[0] | std::uint64_t{drawn[1]} << 32;
    words[1][i] = drawn[2] | std::uint64_t{drawn[3]} << 32;
  }
  for (std::size_t i = 0; i < blocks; ++i) {
    const auto at = static_cast<std::int32_t>(i);
    const int here = places(block_from + number(i), block_second);
    count[i] = static_cast<std::uint64_t>(here);
    share[i] = 1.0 / here;
    inside[i] = (inner <= at) & (at < inner_end);
  }
  // Of each word one cell's place, in the middle half of it, from the low bits; the order of cells from the top ones.
  const auto most = static_cast<std::uint64_t>(std::ceil(places_per_block_));
  for (std::uint64_t k = 0; k < most; ++k) {
    for (std::size_t i = 0; i < blocks; ++i) {
      const std::uint64_t of_order = words[1][i], first = of_order >> 30 & 3, third = 2 - (of_order >> 29 & 1);
      const std::uint64_t cell = first ^ (k & 1) * 3 ^ (k >> 1) * third;  // diagonals first
      const std::uint64_t word = (cell < 2 ? words[0][i] : words[1][i]) >> 32 * (cell & 1);
      first_m[k][i] =
          first_m_ * (2.0 * (block_from + number(i)) + number(cell & 1) + 0.25 + 0x1p-14 * number(word & 0x1fff));
      second_m[k][i] =
          second_m_ * (2.0 * block_second + number(cell >> 1) + 0.25 + 0x1p-14 * number(word >> 13 & 0x1fff));
    }
  }
  std::size_t next = to.count;
  for (std::size_t i = 0; i < blocks; ++i) {
    for (std::size_t k = 0; k < most; ++k) {
      to.first_m[next + k] = first_m[k][i];
      to.second_m[next + k] = second_m[k][i];
      to.share[next + k] = share[i];
      to.inside[next + k] = inside[i];
    }
    next += count[i];
  }
  std::fill_n(to.places.data() + to.count, next - to.count, 1);
  to.count = next;
}

ENSONIFY_WIDE void GroundLattice::add_blocks(const BlockRow& row, std::int64_t from, std::size_t blocks,
                                             LatticePlaces& to) const {
  const auto block_from = static_cast<double>(from), block_second = static_cast<double>(row.row);
  for (std::size_t i = 0; i < blocks; ++i) {
    const double block_first = block_from + static_cast<double>(static_cast<std::int32_t>(i));
    to.first_m[to.count + i] = first_m_ * (2.0 * block_first + 1.0);
    to.second_m[to.count + i] = second_m_ * (2.0 * block_second + 1.0);
    to.share[to.count + i] = 1.0;
    to.inside[to.count + i] = 1;
    to.places[to.count + i] = static_cast<std::uint64_t>(places(block_first, block_second));
  }
  to.count += blocks;
}

/// How far the outline reaches along the first axis between two values of the second; low_m > high_m: it does not.
GroundLattice::Reach GroundLattice::reach(std::span<const Vec2> outline_m, double low_m, double high_m) {
  Reach reach{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  const auto add = [&](double first) {
    reach.low_m = std::min(reach.low_m, first);
    reach.high_m = std::max(reach.high_m, first);
  };
  for (std::size_t k = 0; k < outline_m.size(); ++k) {
    const Vec2 &a = outline_m[k], &b = outline_m[k + 1 < outline_m.size() ? k + 1 : 0];
    if (low_m <= a.y() && a.y() <= high_m) add(a.x());
    for (const double y : {low_m, high_m}) {
      if ((a.y() < y) != (b.y() < y)) add(a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()));
    }
  }
  return reach;
}

/// Between which values of the first axis all of the strip lies in the outline; low_m > high_m: nowhere.
GroundLattice::Reach GroundLattice::inner_reach(std::span<const Vec2> outline_m, double low_m, double high_m) {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  double area = 0.0, lowest = kAll, highest = -kAll;
  for (std::size_t k = 0; k < outline_m.size(); ++k) {
    const Vec2 &a = outline_m[k], &b = outline_m[k + 1 < outline_m.size() ? k + 1 : 0];
    area += a.x() * b.y() - b.x() * a.y();
    lowest = std::min(lowest, a.y()), highest = std::max(highest, a.y());
  }
  if (!(lowest <= low_m && high_m <= highest)) return {kAll, -kAll};
  Reach reach{-kAll, kAll};
  for (std::size_t k = 0; k < outline_m.size(); ++k) {
    const Vec2 &a = outline_m[k], &b = outline_m[k + 1 < outline_m.size() ? k + 1 : 0];
    if (std::max(a.y(), b.y()) < low_m || std::min(a.y(), b.y()) > high_m) continue;
    const double rise = b.y() - a.y();
    if (rise == 0.0) return {kAll, -kAll};
    for (const double y : {a.y(), b.y()}) {
      const double first = a.x() + (b.x() - a.x()) * (std::clamp(y, low_m, high_m) - a.y()) / rise;
      if ((rise > 0.0) == (area > 0.0)) {  // the outline lies below it on the first axis
        reach.high_m = std::min(reach.high_m, first);
      } else {
        reach.low_m = std::max(reach.low_m, first);
      }
    }
  }
  return reach;
}

}  // namespace ensonify::trace
