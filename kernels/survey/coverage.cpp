#include "kernels/survey/coverage.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ensonify::survey {
namespace {

Vec2 forward_of(const Rectangle& r) { return {std::sin(r.heading_rad), std::cos(r.heading_rad)}; }
Vec2 starboard_of(const Rectangle& r) { return {std::cos(r.heading_rad), -std::sin(r.heading_rad)}; }

std::size_t cells(double extent_m, double cell_m) {
  return static_cast<std::size_t>(std::max(1.0, std::round(extent_m / cell_m)));
}

std::size_t steps_within(double extent_m, double step_m) {
  return static_cast<std::size_t>(std::max(1.0, std::floor(extent_m / step_m + 1e-9)));
}

}  // namespace

Runline line_across(const Rectangle& r, double across_m, bool back) {
  const Vec2 middle = r.centre_enu_m + (across_m - 0.5 * r.width_m) * starboard_of(r);
  const Vec2 half = 0.5 * r.length_m * forward_of(r);
  const Runline line{middle - half, middle + half};
  return back ? runlines::reversed(line) : line;
}

Coverage::Coverage(const Rectangle& r, double cell_m, int needed)
    : cell_m_(cell_m),
      needed_(static_cast<std::uint32_t>(needed)),
      forward_(forward_of(r)),
      starboard_(starboard_of(r)),
      corner_enu_m_(r.centre_enu_m - 0.5 * r.length_m * forward_ - 0.5 * r.width_m * starboard_),
      columns_(cells(r.width_m, cell_m)),
      rows_(cells(r.length_m, cell_m)),
      soundings_(cell_m),
      cells_(columns_ * rows_) {
  if (needed < 1) throw std::invalid_argument("Coverage: needed must be at least 1");
}

void Coverage::add(const Vec2& place_enu_m, double height_m) {
  const Vec2 off = place_enu_m - corner_enu_m_;
  const double across_m = off.dot(starboard_), along_m = off.dot(forward_);
  const double column = std::floor(across_m / cell_m_), row = std::floor(along_m / cell_m_);
  if (!(column >= 0.0 && row >= 0.0 && column < static_cast<double>(columns_) && row < static_cast<double>(rows_))) {
    return;
  }
  soundings_.add(across_m, along_m, -height_m, std::numeric_limits<double>::quiet_NaN());
  ++cells_[static_cast<std::size_t>(column) * rows_ + static_cast<std::size_t>(row)].of_this_line;
}

void Coverage::end_line() {
  for (Cell& cell : cells_) {
    cell.lines += cell.of_this_line >= needed_;
    cell.of_this_line = 0;
  }
}

std::vector<CoveredEdge> Coverage::open_rows(double across_m, double head_height_m) const {
  constexpr std::size_t kNear = 3;  // cells from the edge back that give its depth: the shallowest counts
  const auto first =
      static_cast<std::size_t>(std::clamp(std::floor(across_m / cell_m_), 0.0, static_cast<double>(columns_ - 1)));
  std::vector<CoveredEdge> open;
  double least_known_m = std::numeric_limits<double>::infinity();
  for (std::size_t row = 0; row < rows_; ++row) {
    std::size_t end = first;
    while (end < columns_ && is_covered(end, row)) ++end;
    if (end == columns_) continue;
    double depth_m = std::numeric_limits<double>::infinity();
    for (std::size_t column = end; column + kNear >= end; --column) {
      const double height = height_m(column, row);
      if (!std::isnan(height)) depth_m = std::min(depth_m, head_height_m - height);
      if (column == 0) break;
    }
    open.push_back({static_cast<double>(end) * cell_m_, depth_m});
    least_known_m = std::min(least_known_m, depth_m);
  }
  if (std::isinf(least_known_m)) return {};
  for (CoveredEdge& edge : open) {
    if (std::isinf(edge.depth_m)) edge.depth_m = least_known_m;
  }
  return open;
}

double Coverage::take_holes(double reach_m) {
  std::size_t most = 0, best = 0;
  for (std::size_t column = 0; column < columns_; ++column) {
    std::size_t count = 0;
    for (std::size_t row = 0; row < rows_; ++row) count += !is_covered(column, row) && !at(column, row).marked;
    if (count > most) most = count, best = column;
  }
  if (most == 0) return std::numeric_limits<double>::quiet_NaN();
  const double across_m = (static_cast<double>(best) + 0.5) * cell_m_;
  for (std::size_t column = 0; column < columns_; ++column) {
    if (std::abs((static_cast<double>(column) + 0.5) * cell_m_ - across_m) > reach_m) continue;
    for (std::size_t row = 0; row < rows_; ++row) cells_[column * rows_ + row].marked = true;
  }
  return across_m;
}

Coverage::Depths Coverage::depths(double head_height_m) const {
  double least_m = std::numeric_limits<double>::infinity(), most_m = -least_m;
  for (std::size_t column = 0; column < columns_; ++column) {
    for (std::size_t row = 0; row < rows_; ++row) {
      if (!is_covered(column, row)) continue;
      const double depth_m = head_height_m - height_m(column, row);
      least_m = std::min(least_m, depth_m);
      most_m = std::max(most_m, depth_m);
    }
  }
  return least_m <= most_m ? Depths{least_m, most_m} : Depths{};
}

double Coverage::covered() const { return 1.0 - static_cast<double>(holes()) / static_cast<double>(cells_.size()); }

double Coverage::overlapped() const {
  std::size_t covered = 0, lines = 0;
  for (const Cell& cell : cells_) {
    covered += cell.lines > 0;
    lines += cell.lines;
  }
  return covered == 0 ? 0.0 : static_cast<double>(lines) / static_cast<double>(covered);
}

std::size_t Coverage::holes() const {
  std::size_t covered = 0;
  soundings_.each(
      [&](std::int64_t, std::int64_t, const survey_grid::CellSums& sums) { covered += sums.count() >= needed_; });
  return cells_.size() - covered;
}

CubeSearch::CubeSearch(const Rectangle& r, double step_m)
    : step_m_(step_m),
      forward_(forward_of(r)),
      starboard_(forward_.y(), -forward_.x()),
      corner_enu_m_(r.centre_enu_m - 0.5 * r.length_m * forward_ - 0.5 * r.width_m * starboard_) {
  if (!(step_m > 0.0)) throw std::invalid_argument("CubeSearch: step_m must be above 0");
  columns_ = steps_within(r.width_m, step_m);
  rows_ = steps_within(r.length_m, step_m);
  cells_.resize(columns_ * rows_);
}

void CubeSearch::add(const Vec2& place_enu_m) {
  const Vec2 off = place_enu_m - corner_enu_m_;
  const double column = std::floor(off.dot(starboard_) / step_m_), row = std::floor(off.dot(forward_) / step_m_);
  if (!(column >= 0.0 && row >= 0.0 && column < static_cast<double>(columns_) && row < static_cast<double>(rows_))) {
    return;
  }
  ++cells_[static_cast<std::size_t>(column) * rows_ + static_cast<std::size_t>(row)];
}

CubeSearch::Sums CubeSearch::sums() const {
  Sums sums((columns_ + 1) * (rows_ + 1));
  for (std::size_t column = 0; column < columns_; ++column) {
    std::uint32_t along = 0;
    for (std::size_t row = 0; row < rows_; ++row) {
      along += cells_[column * rows_ + row];
      sums[(column + 1) * (rows_ + 1) + row + 1] = sums[column * (rows_ + 1) + row + 1] + along;
    }
  }
  return sums;
}

bool CubeSearch::holds(const Sums& sums, std::size_t column, std::size_t row, std::size_t side, int needed) const {
  const std::uint32_t* near = &sums[column * (rows_ + 1)];
  const std::uint32_t* far = &sums[(column + side) * (rows_ + 1)];
  return far[row + side] - far[row] - near[row + side] + near[row] >= static_cast<std::uint32_t>(needed);
}

double CubeSearch::found(const Sums& sums, std::size_t side, int needed) const {
  if (side == 0 || side > columns_ || side > rows_) return 0.0;
  std::size_t found = 0;
  for (std::size_t column = 0; column + side <= columns_; ++column) {
    for (std::size_t row = 0; row + side <= rows_; ++row) found += holds(sums, column, row, side, needed);
  }
  return static_cast<double>(found) / static_cast<double>((columns_ - side + 1) * (rows_ - side + 1));
}

/// That any place of a cube holds.
std::size_t CubeSearch::whole_cells(double side_m) const {
  return static_cast<std::size_t>(std::max(0.0, std::floor(side_m / step_m_ + 1e-9) - 1.0));
}

double CubeSearch::found(double side_m, int needed) const { return found(sums(), whole_cells(side_m), needed); }

double CubeSearch::found(const std::function<double(double across_m, double along_m)>& side_m, int needed) const {
  const Sums all = sums();
  std::size_t places = 0, found = 0;
  for (std::size_t column = 0; column < columns_; ++column) {
    for (std::size_t row = 0; row < rows_; ++row) {
      const std::size_t side = whole_cells(
          side_m((static_cast<double>(column) + 0.5) * step_m_, (static_cast<double>(row) + 0.5) * step_m_));
      if (column + side > columns_ || row + side > rows_) continue;
      ++places;
      found += side > 0 && holds(all, column, row, side, needed);
    }
  }
  return places > 0 ? static_cast<double>(found) / static_cast<double>(places) : 0.0;
}

double CubeSearch::smallest_side_m(int needed, double share) const {
  const Sums all = sums();
  std::size_t too_small = 0, enough = std::min(columns_, rows_);
  if (found(all, enough, needed) < share) return std::numeric_limits<double>::infinity();
  while (enough - too_small > 1) {
    const std::size_t middle = (too_small + enough) / 2;
    (found(all, middle, needed) >= share ? enough : too_small) = middle;
  }
  return static_cast<double>(enough + 1) * step_m_;
}

}  // namespace ensonify::survey
