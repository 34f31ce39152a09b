#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "kernels/survey/coverage.h"

namespace ensonify::survey {

/// Smallest cube on the seabed that soundings hit. They are counted in small cells of a rectangle;
/// a cube stands anywhere inside it, upright, its sides along the rectangle's. Counted are soundings whose place lies
/// on it: that it rises towards the sonar, and how strong its echo is, are left out.
class CubeSearch {
 public:
  /// step_m > 0: side of the cells, to which answers are known.
  CubeSearch(const Rectangle& rectangle, double step_m);

  /// Takes a sounding; nothing happens outside the rectangle.
  void add(const Vec2& place_enu_m);

  /// Share of the places where a cube of that side holds at least `needed` soundings. At most two steps of the side are
  /// taken off, so that it holds wherever the cube stands between cells. 0 for sides below two steps.
  double found(double side_m, int needed) const;

  /// The same of cubes whose side depends on where they stand: `side_m` gives it by how far the corner nearest to the
  /// rectangle's own port and back one lies from that, across and along, m.
  double found(const std::function<double(double across_m, double along_m)>& side_m, int needed) const;

  /// The smallest side, a multiple of the step, at which at least a share of the places is found; infinite if the
  /// whole rectangle, or its shorter side, does not suffice.
  double smallest_side_m(int needed, double share) const;

 private:
  using Sums = std::vector<std::uint32_t>;
  /// Soundings of all cells before a corner, both ways.
  Sums sums() const;
  double found(const Sums& sums, std::size_t cells, int needed) const;
  bool holds(const Sums& sums, std::size_t column, std::size_t row, std::size_t side, int needed) const;
  std::size_t whole_cells(double side_m) const;

  double step_m_;
  Vec2 forward_, starboard_, corner_enu_m_;
  std::size_t columns_, rows_;
  std::vector<std::uint32_t> cells_;
};

}  // namespace ensonify::survey
