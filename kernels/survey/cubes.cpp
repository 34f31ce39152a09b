#include "kernels/survey/cubes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ensonify::survey {
namespace {

std::size_t cells(double extent_m, double step_m) {
  return static_cast<std::size_t>(std::max(1.0, std::floor(extent_m / step_m + 1e-9)));
}

}  // namespace

CubeSearch::CubeSearch(const Rectangle& r, double step_m)
    : step_m_(step_m),
      forward_(std::sin(r.heading_rad), std::cos(r.heading_rad)),
      starboard_(forward_.y(), -forward_.x()),
      corner_enu_m_(r.centre_enu_m - 0.5 * r.length_m * forward_ - 0.5 * r.width_m * starboard_) {
  if (!(step_m > 0.0)) throw std::invalid_argument("CubeSearch: step_m must be above 0");
  columns_ = cells(r.width_m, step_m);
  rows_ = cells(r.length_m, step_m);
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
