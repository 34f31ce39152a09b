#include "tools/georeference/survey_file.h"

namespace ensonify::georeference_tool {

frames::Geodetic position_of(const frames::LocalProjection& projection, const frames::Vec2& reference,
                             const frames::Vec2& away_true) {
  const double turn_rad = projection.convergence_rad(reference);
  const frames::Vec2 on_grid(std::cos(turn_rad) * away_true.x() - std::sin(turn_rad) * away_true.y(),
                             std::sin(turn_rad) * away_true.x() + std::cos(turn_rad) * away_true.y());
  return projection.geodetic_of(reference + on_grid);
}

}  // namespace ensonify::georeference_tool
