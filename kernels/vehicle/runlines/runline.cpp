#include "kernels/vehicle/runlines/runline.h"

#include <cmath>

namespace ensonify::runlines {
namespace {

Vec2 direction(const Runline& line) { return (line.end_enu_m - line.start_enu_m).normalized(); }
Vec2 starboard_of(const Vec2& forward) { return {forward.y(), -forward.x()}; }

}  // namespace

double length_m(const Runline& line) { return (line.end_enu_m - line.start_enu_m).norm(); }

double heading_rad(const Runline& line) {
  const Vec2 forward = direction(line);
  return frames::wrap_two_pi(std::atan2(forward.x(), forward.y()));
}

Runline reversed(const Runline& line) { return {line.end_enu_m, line.start_enu_m}; }

LinePosition line_position(const Runline& line, const Vec2& position_enu_m) {
  const Vec2 forward = direction(line);
  const Vec2 offset = position_enu_m - line.start_enu_m;
  return {offset.dot(forward), offset.dot(starboard_of(forward))};
}

Vec2 point_on(const Runline& line, double along_m) { return line.start_enu_m + along_m * direction(line); }

double line_of_sight_heading_rad(const Runline& line, const Vec2& position_enu_m, double lookahead_m) {
  const double cross_track_m = line_position(line, position_enu_m).cross_track_m;
  return frames::wrap_two_pi(heading_rad(line) - std::atan2(cross_track_m, lookahead_m));
}

std::vector<Runline> lawnmower(const Vec2& centre_enu_m, double heading, double length, double spacing_m, int count) {
  const Vec2 forward(std::sin(heading), std::cos(heading));
  std::vector<Runline> lines;
  for (int i = 0; i < count; ++i) {
    const Vec2 middle = centre_enu_m + (i - 0.5 * (count - 1)) * spacing_m * starboard_of(forward);
    const Runline line{middle - 0.5 * length * forward, middle + 0.5 * length * forward};
    lines.push_back(i % 2 == 0 ? line : reversed(line));
  }
  return lines;
}

Runline extended(const Runline& line, double run_in_m, double run_out_m) {
  return {point_on(line, -run_in_m), point_on(line, length_m(line) + run_out_m)};
}

}  // namespace ensonify::runlines
