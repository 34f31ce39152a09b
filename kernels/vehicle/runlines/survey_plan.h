#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "kernels/vehicle/runlines/runline.h"

namespace ensonify::runlines {

/// Heights on a square lattice, ENU up, row by row from the south-west post; NaN where nothing is known.
struct HeightGrid {
  double west_m = 0.0;  // of the first post
  double south_m = 0.0;
  double spacing_m = 1.0;
  std::size_t columns = 0;  // to the east
  std::size_t rows = 0;     // to the north
  std::span<const float> height_m;

  /// Height of the nearest post; NaN outside.
  double nearest_height_m(const Vec2& place_enu_m) const;
};

/// Request for a survey.
struct SurveyRequest {
  int most_lines = 5;
  double longest_line_m = 500.0;
  double shortest_line_m = 20.0;      // less is not worth a line
  double swath_rad = 2.27;            // full angle
  double overlap = 0.2;               // of neighbouring swaths over the shallowest ground, 0..1
  std::optional<double> spacing_m;    // given: instead of the overlap
  std::optional<double> heading_rad;  // grid; not given: along north or east, whichever takes the longer lines
  double head_height_m = 0.0;         // ENU z of the head
  double least_water_m = 2.0;         // ground nearer to the head than this counts as a hole
  double turn_room_m = 0.0;           // wanted inside the hole-free area beyond both ends of the lines
  double run_in_m = 0.0;              // needed there
};

struct SurveyPlan {
  std::vector<Runline> lines;
  double spacing_m = 0.0;
  double least_depth_m = 0.0;     // below the head, in the surveyed rectangle
  double greatest_depth_m = 0.0;  // there
};

/// There is no room for even one line; the text says what there is and what it would take.
struct NoRoom : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Parallel lines in the middle of the largest rectangle without holes, counted up to the size that the wish can use;
/// every swath lies in that rectangle down to its greatest depth. Turn room is given up before the survey is. Throws
/// NoRoom.
SurveyPlan plan_survey(const HeightGrid& ground, const SurveyRequest& request);

}  // namespace ensonify::runlines
