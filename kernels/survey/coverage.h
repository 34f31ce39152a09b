#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "kernels/survey/grid/soundings.h"
#include "kernels/survey/spacing.h"
#include "kernels/vehicle/runlines/runline.h"

namespace ensonify::survey {

using runlines::Runline;
using runlines::Vec2;

/// A rectangle that a survey covers with parallel lines, each to starboard of the one before (seen along the first).
struct Rectangle {
  Vec2 centre_enu_m = Vec2::Zero();
  double heading_rad = 0.0;  // grid, along the lines
  double length_m = 100.0;   // along them
  double width_m = 100.0;    // across
};

/// The line `across_m` from the rectangle's port edge, along its heading or back.
Runline line_across(const Rectangle& rectangle, double across_m, bool back);

/// Coverage by soundings, cell by cell, and the place of the next line.
class Coverage {
 public:
  /// A cell is covered when it holds `needed` soundings. cell_m > 0, needed >= 1.
  Coverage(const Rectangle& rectangle, double cell_m, int needed);

  /// Takes a sounding; nothing happens outside the rectangle.
  void add(const Vec2& place_enu_m, double height_m);
  /// A line has been run: what it covered by itself counts for `overlapped`.
  void end_line();

  /// Rows to starboard of `across_m`, where the last line lies, that are not covered to the rectangle's edge: where
  /// their coverage ends, and the depth below `head_height_m` (ENU z) there. A row that has no depth near its edge
  /// takes the least of its neighbours'; rows are left out while no depth is known at all.
  std::vector<CoveredEdge> open_rows(double across_m, double head_height_m) const;

  /// Across position of the column that lies in the middle of most uncovered cells not marked before, which are then
  /// marked within `reach_m` of it: a line over holes is run once. NaN when none is left.
  double take_holes(double reach_m);

  /// Depths below `head_height_m` (ENU z) of what is covered; all 0 when nothing is.
  struct Depths {
    double shallowest_m = 0.0, deepest_m = 0.0;  // mean of a cell's soundings
  };
  Depths depths(double head_height_m) const;

  double covered() const;     // share of the cells
  double overlapped() const;  // how often a covered cell was covered, by lines, on average; 0 before the first line
  std::size_t holes() const;  // cells not covered

  std::size_t columns() const { return columns_; }  // across
  std::size_t rows() const { return rows_; }        // ahead
  Vec2 corner_enu_m() const { return corner_enu_m_; }
  std::uint32_t soundings(std::size_t column, std::size_t row) const { return sums(column, row).count(); }
  /// Mean of the cell's soundings; NaN without.
  double height_m(std::size_t column, std::size_t row) const { return -sums(column, row).mean_m(); }

 private:
  struct Cell {
    std::uint32_t of_this_line = 0, lines = 0;
    bool marked = false;
  };
  const Cell& at(std::size_t column, std::size_t row) const { return cells_[column * rows_ + row]; }
  const survey_grid::CellSums& sums(std::size_t column, std::size_t row) const {
    return soundings_.at(static_cast<std::int64_t>(column), static_cast<std::int64_t>(row));
  }
  bool is_covered(std::size_t column, std::size_t row) const { return soundings(column, row) >= needed_; }

  double cell_m_;
  std::uint32_t needed_;
  Vec2 forward_, starboard_, corner_enu_m_;
  std::size_t columns_, rows_;
  survey_grid::SoundingGrid soundings_;  // across and along from the corner
  std::vector<Cell> cells_;
};

/// Uncertainty that an order of S-44 allows a sounding, at 95 % [S44]: vertically sqrt(a^2 + (b depth)^2),
/// horizontally a radius and a share of the depth. And the side of the cubes that its full feature search must find: a
/// length, below some depth a share of the depth.
struct SurveyOrder {
  double a_m, b;
  double radius_m, radius_share;
  double cube_m, deep_from_m, deep_cube_share;
};

inline constexpr SurveyOrder kSpecialOrder{0.25, 0.0075, 2.0, 0.0, 1.0, INFINITY, 0.0};
inline constexpr SurveyOrder kOrder1a{0.5, 0.013, 5.0, 0.05, 2.0, 40.0, 0.1};

/// Whether a sounding's total vertical and horizontal uncertainty are within the order's, at a depth >= 0.
inline bool meets(const SurveyOrder& order, double depth_m, double tvu_m, double thu_m) {
  return tvu_m <= std::hypot(order.a_m, order.b * depth_m) && thu_m <= order.radius_m + order.radius_share * depth_m;
}

/// Side of the cubes to be found at a depth >= 0.
inline double cube_m(const SurveyOrder& order, double depth_m) {
  return depth_m > order.deep_from_m ? order.deep_cube_share * depth_m : order.cube_m;
}

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
