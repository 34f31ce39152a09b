#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "kernels/base/frames/attitude.h"
#include "kernels/base/random/stream.h"

namespace ensonify::trace {

/// Places on a lattice's axes, side by side; or whole blocks of them, by their middles.
struct LatticePlaces {
  static constexpr std::size_t kMost = 256;
  std::size_t count = 0;
  std::array<double, kMost> first_m, second_m;
  std::array<double, kMost> share;          // of its block's area that is a place's; a block's is all of it
  std::array<std::uint64_t, kMost> inside;  // 1: in the outline even when that shrinks by the margin; else 0
  std::array<std::uint64_t, kMost> places;  // 1, or as many as the block has
};

/// Places of the world to aim rays at, so that a ping's rays hit the seabed where those of the ping before did.
///
/// A jittered lattice on a horizontal plane, of about one place per first_m x second_m. So that pings whose rays are
/// spaced a little differently still share places, spacings are powers of two of a metre and the axes stand at
/// multiples of 15 degrees; what is too many is left out of each block of 2 x 2 in an order that belongs to the block.
/// Each place is at random within the middle half of its cell of the lattice: more even than chance, yet no pattern.
class GroundLattice {
 public:
  /// The first axis lies within 7.5 degrees of `along`, a direction (of any length above 0, either sense).
  GroundLattice(const frames::Vec2& along_enu, double first_m, double second_m);

  /// From east and north to the lattice's axes, and back. A turn about the world's origin.
  frames::Vec2 on_axes(const frames::Vec2& place_enu) const;
  const frames::Vec2& first_axis_enu() const { return first_axis_; }
  double block_m2() const { return 4.0 * first_m_ * second_m_; }
  frames::Vec2 second_axis_enu() const { return {-first_axis_.y(), first_axis_.x()}; }

  /// Whether blocks that are inside come one by one, or their places.
  enum class Inside { kPlaces, kBlocks };
  /// visit(LatticePlaces) for some after others of the places within a convex outline (on these axes too) that is grown
  /// by margin_m, and of some more around it; always in the same order. A place is a function of (stream, lattice,
  /// block).
  template <class Visit>
  void within(const random::Stream& stream, std::span<const frames::Vec2> outline_m, double margin_m, Inside inside,
              const Visit& visit) const;

 private:
  struct Reach {
    double low_m, high_m;
  };
  static Reach reach(std::span<const frames::Vec2> outline_m, double low_m, double high_m);
  static Reach inner_reach(std::span<const frames::Vec2> outline_m, double low_m, double high_m);
  /// Blocks first..end - 1 of a row; those from inner to inner_end - 1 are inside.
  struct BlockRow {
    std::int64_t row, first, inner, inner_end, end;
  };
  template <class Visit>
  void each_row(std::span<const frames::Vec2> outline_m, double margin_m, const Visit& visit) const;
  static constexpr std::size_t kMostPlaces = 4, kBlocks = 32;  // of a block; at once
  static_assert(kMostPlaces * kBlocks <= LatticePlaces::kMost);
  int places(double block_first, double block_second) const;
  /// Appends the places of a row's blocks `from` on, so many, at most kBlocks; or these blocks themselves.
  void add_places(const random::Row& bits, const BlockRow& row, std::int64_t from, std::size_t blocks,
                  LatticePlaces& to) const;
  void add_blocks(const BlockRow& row, std::int64_t from, std::size_t blocks, LatticePlaces& to) const;

  frames::Vec2 first_axis_;
  double first_m_, second_m_;  // of the lattice
  double places_per_block_;    // above 1, at most 4
  std::uint64_t name_;         // of the lattice among all
};

inline frames::Vec2 GroundLattice::on_axes(const frames::Vec2& place_enu) const {
  return {first_axis_.dot(place_enu), second_axis_enu().dot(place_enu)};
}

/// Blocks with one place more lie evenly among the others: the additive recurrence of the plastic number
/// [Roberts2018].
inline int GroundLattice::places(double block_first, double block_second) const {
  const double turn = 0.7548776662466927 * block_first + 0.5698402909980532 * block_second;
  return static_cast<int>(places_per_block_ + (turn - std::floor(turn)));
}

template <class Visit>
void GroundLattice::each_row(std::span<const frames::Vec2> outline_m, double margin_m, const Visit& visit) const {
  double low = outline_m[0].y(), high = low;
  for (const frames::Vec2& corner : outline_m) low = std::min(low, corner.y()), high = std::max(high, corner.y());
  const double per_first = 0.5 / first_m_, per_second = 0.5 / second_m_;
  const auto last_row = static_cast<std::int64_t>(std::floor((high + margin_m) * per_second));
  for (auto j = static_cast<std::int64_t>(std::floor((low - margin_m) * per_second)); j <= last_row; ++j) {
    const auto second = static_cast<double>(j);
    const double from_m = second / per_second - margin_m, to_m = (second + 1.0) / per_second + margin_m;
    const Reach row = reach(outline_m, from_m, to_m);
    if (!(row.low_m <= row.high_m)) continue;
    const auto end = static_cast<std::int64_t>(std::floor((row.high_m + margin_m) * per_first)) + 1;
    BlockRow blocks{j, static_cast<std::int64_t>(std::floor((row.low_m - margin_m) * per_first)), end, end, end};
    const Reach inner = inner_reach(outline_m, from_m, to_m);
    const double inner_first = std::ceil((inner.low_m + margin_m) * per_first),
                 inner_end = std::floor((inner.high_m - margin_m) * per_first);
    if (inner_first < inner_end) {
      blocks.inner = static_cast<std::int64_t>(inner_first);
      blocks.inner_end = static_cast<std::int64_t>(inner_end);
    }
    visit(blocks);
  }
}

template <class Visit>
void GroundLattice::within(const random::Stream& stream, std::span<const frames::Vec2> outline_m, double margin_m,
                           Inside inside, const Visit& visit) const {
  LatticePlaces some;
  each_row(outline_m, margin_m, [&](const BlockRow& blocks) {
    const random::Row bits(stream, (static_cast<std::uint64_t>(blocks.row) << 20) ^ name_);
    const auto add = [&](std::int64_t from, std::int64_t to, bool whole) {
      while (from < to) {
        const std::size_t count = std::min(kBlocks, static_cast<std::size_t>(to - from));
        if (some.count + kMostPlaces * count > LatticePlaces::kMost) visit(some), some.count = 0;
        if (whole) {
          add_blocks(blocks, from, count, some);
        } else {
          add_places(bits, blocks, from, count, some);
        }
        from += static_cast<std::int64_t>(count);
      }
    };
    if (inside == Inside::kPlaces) {
      add(blocks.first, blocks.end, false);
    } else {
      add(blocks.first, blocks.inner, false);
      add(blocks.inner, blocks.inner_end, true);
      add(blocks.inner_end, blocks.end, false);
    }
  });
  if (some.count > 0) visit(some);
}

}  // namespace ensonify::trace
