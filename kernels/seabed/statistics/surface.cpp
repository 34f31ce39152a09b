#include "kernels/seabed/statistics/surface.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace ensonify::relief_statistics {

void check(const Surface& surface) {
  if (surface.columns < 1 || surface.rows < 1 || !(surface.spacing_m > 0.0) ||
      surface.height_m.size() != static_cast<std::size_t>(surface.columns) * static_cast<std::size_t>(surface.rows)) {
    throw std::invalid_argument("surface: " + std::to_string(surface.height_m.size()) + " heights for " +
                                std::to_string(surface.columns) + " x " + std::to_string(surface.rows) +
                                " posts; allowed: one height per post, at least one post, a positive spacing");
  }
}

bool patch_of(const Surface& surface, int column, int row, int cells, Patch& patch) {
  patch.residual_m.clear();
  const double centre = 0.5 * (cells - 1);
  double sum = 0.0, sum_x = 0.0, sum_y = 0.0, sum_xx = 0.0;
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const double z = surface.at(column + i, row + j);
      if (std::isnan(z)) return false;
      patch.residual_m.push_back(z);
      sum += z;
      sum_x += z * (i - centre);
      sum_y += z * (j - centre);
      sum_xx += (i - centre) * (i - centre);
    }
  }
  patch.mean_m = sum / (static_cast<double>(cells) * cells);
  const double per_cell_x = sum_xx > 0.0 ? sum_x / sum_xx : 0.0, per_cell_y = sum_xx > 0.0 ? sum_y / sum_xx : 0.0;
  std::size_t post = 0;
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i)
      patch.residual_m[post++] -= patch.mean_m + per_cell_x * (i - centre) + per_cell_y * (j - centre);
  }
  patch.east_slope = per_cell_x / surface.spacing_m;
  patch.north_slope = per_cell_y / surface.spacing_m;
  return true;
}

}  // namespace ensonify::relief_statistics
