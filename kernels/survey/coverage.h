#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

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
  std::uint32_t soundings(std::size_t column, std::size_t row) const { return at(column, row).soundings; }
  /// Mean of the cell's soundings; NaN without.
  double height_m(std::size_t column, std::size_t row) const;

 private:
  struct Cell {
    std::uint32_t soundings = 0, of_this_line = 0, lines = 0;
    bool marked = false;
    double sum_m = 0.0;
  };
  const Cell& at(std::size_t column, std::size_t row) const { return cells_[column * rows_ + row]; }
  bool is_covered(std::size_t column, std::size_t row) const { return at(column, row).soundings >= needed_; }

  double cell_m_;
  std::uint32_t needed_;
  Vec2 forward_, starboard_, corner_enu_m_;
  std::size_t columns_, rows_;
  std::vector<Cell> cells_;
};

}  // namespace ensonify::survey
