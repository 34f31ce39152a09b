#include "kernels/vehicle/vertical/reduction.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ensonify::vertical {

Separation::Separation(const frames::Vec2& south_west_enu_m, double spacing_m, std::size_t columns, std::size_t rows,
                       std::vector<double> values_m)
    : south_west_enu_m_(south_west_enu_m),
      spacing_m_(spacing_m),
      columns_(columns),
      rows_(rows),
      values_m_(std::move(values_m)) {
  if (columns < 2 || rows < 2 || values_m_.size() != columns * rows || !(spacing_m > 0.0)) {
    throw std::invalid_argument("separation: a grid needs 2 x 2 posts or more, all of them, and a spacing above 0");
  }
  if (!std::all_of(values_m_.begin(), values_m_.end(), [](double v) { return std::isfinite(v); })) {
    throw std::invalid_argument("separation: a post has no value");
  }
}

double Separation::at(const frames::Vec2& place_enu_m) const {
  if (values_m_.empty()) return constant_m_;
  const frames::Vec2 cell = (place_enu_m - south_west_enu_m_) / spacing_m_;
  const double x = std::clamp(cell.x(), 0.0, static_cast<double>(columns_ - 1));
  const double y = std::clamp(cell.y(), 0.0, static_cast<double>(rows_ - 1));
  const std::size_t column = std::min(static_cast<std::size_t>(x), columns_ - 2);
  const std::size_t row = std::min(static_cast<std::size_t>(y), rows_ - 2);
  const double u = x - static_cast<double>(column), v = y - static_cast<double>(row);
  const double* south = &values_m_[row * columns_ + column];
  const double* north = south + columns_;
  return (1.0 - v) * ((1.0 - u) * south[0] + u * south[1]) + v * ((1.0 - u) * north[0] + u * north[1]);
}

bool Separation::covers(const frames::Vec2& place_enu_m) const {
  if (values_m_.empty()) return true;
  const frames::Vec2 cell = (place_enu_m - south_west_enu_m_) / spacing_m_;
  return cell.minCoeff() >= -0.5 && cell.x() <= static_cast<double>(columns_) - 0.5 &&
         cell.y() <= static_cast<double>(rows_) - 0.5;
}

double geoid_height_m(const Datums& datums, const frames::Vec3& point_enu_m) {
  return point_enu_m.z() + datums.datum_above_geoid.at(point_enu_m.head<2>());
}

double depth_below_water_m(const frames::Vec3& point_enu_m, double water_level_m) {
  return water_level_m - point_enu_m.z();
}

}  // namespace ensonify::vertical
