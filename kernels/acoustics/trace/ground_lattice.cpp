#include "kernels/acoustics/trace/ground_lattice.h"

#include <algorithm>
#include <limits>
#include <numbers>

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
