#include "kernels/vehicle/runlines/runline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace ensonify::runlines {
namespace {

Vec2 direction(const Runline& line) { return (line.end_enu_m - line.start_enu_m).normalized(); }
Vec2 starboard_of(const Vec2& forward) { return {forward.y(), -forward.x()}; }

constexpr double kPi = std::numbers::pi;

Vec2 forward(double heading_rad) { return {std::sin(heading_rad), std::cos(heading_rad)}; }
Vec2 starboard(double heading_rad) { return {std::cos(heading_rad), -std::sin(heading_rad)}; }
double bearing_rad(const Vec2& v) { return std::atan2(v.x(), v.y()); }

Waypose after(const Leg& leg, double along_m) {
  const double heading = leg.start.heading_rad;
  if (leg.turn_per_m == 0.0) return {leg.start.position_enu_m + along_m * forward(heading), heading};
  const double half_turn = 0.5 * along_m * leg.turn_per_m;
  const double chord_m = 2.0 * std::sin(half_turn) / leg.turn_per_m;
  return {leg.start.position_enu_m + chord_m * forward(heading + half_turn),
          frames::wrap_two_pi(heading + 2.0 * half_turn)};
}

/// How far to turn from one heading to another when turning to `side` only (+1 starboard, -1 port), in [0, 2 pi).
double turn_rad(double from_rad, double to_rad, double side) {
  const double turn = frames::wrap_two_pi(side * (to_rad - from_rad));
  return turn > 2.0 * kPi - 1e-9 ? 0.0 : turn;  // rounding must not add a full circle
}

struct Shape {
  std::array<double, 3> side;  // +1 starboard, -1 port, 0 straight
  std::array<double, 3> length_m;
};

/// Arc, straight line, arc: the line is a common tangent of the two circles.
std::optional<Shape> arc_line_arc(const Waypose& from, const Waypose& to, double radius_m, double first, double last) {
  const Vec2 centre_from = from.position_enu_m + first * radius_m * starboard(from.heading_rad);
  const Vec2 centre_to = to.position_enu_m + last * radius_m * starboard(to.heading_rad);
  const Vec2 between = centre_to - centre_from;
  const double apart_m = between.norm();
  double line_m = apart_m;
  double line_heading = apart_m > 0.0 ? bearing_rad(between) : from.heading_rad;
  if (first != last) {  // the tangent crosses between the circles
    if (apart_m < 2.0 * radius_m) return std::nullopt;
    line_m = std::sqrt(apart_m * apart_m - 4.0 * radius_m * radius_m);
    line_heading += first * std::atan2(2.0 * radius_m, line_m);
  }
  return Shape{{first, 0.0, last},
               {radius_m * turn_rad(from.heading_rad, line_heading, first), line_m,
                radius_m * turn_rad(line_heading, to.heading_rad, last)}};
}

/// Three arcs, the middle one the other way round on a circle that touches both others.
std::optional<Shape> arc_arc_arc(const Waypose& from, const Waypose& to, double radius_m, double side) {
  const Vec2 centre_from = from.position_enu_m + side * radius_m * starboard(from.heading_rad);
  const Vec2 centre_to = to.position_enu_m + side * radius_m * starboard(to.heading_rad);
  const Vec2 between = centre_to - centre_from;
  const double apart_m = between.norm();
  if (apart_m > 4.0 * radius_m || apart_m == 0.0) return std::nullopt;
  // The middle circle's centre is the apex of a triangle of sides 2R, 2R and `apart`; the turn about it exceeds pi.
  const double corner = std::acos(apart_m / (4.0 * radius_m));
  const double towards_middle = bearing_rad(between) + side * corner;
  const double leave_heading = towards_middle + side * kPi / 2.0;  // heading where the first and middle circles touch
  const double middle_turn = kPi + 2.0 * corner;
  const double join_heading = leave_heading - side * middle_turn;
  return Shape{{side, -side, side},
               {radius_m * turn_rad(from.heading_rad, leave_heading, side), radius_m * middle_turn,
                radius_m * turn_rad(join_heading, to.heading_rad, side)}};
}

Turn turn_of(const Shape& shape, const Waypose& from, double radius_m) {
  Turn turn;
  Waypose start = from;
  for (std::size_t i = 0; i < 3; ++i) {
    turn.legs[i] = {start, shape.length_m[i], shape.side[i] / radius_m};
    start = after(turn.legs[i], shape.length_m[i]);
  }
  return turn;
}

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

double Turn::length_m() const { return legs[0].length_m + legs[1].length_m + legs[2].length_m; }

Waypose Turn::at(double along_m) const {
  double left_m = std::clamp(along_m, 0.0, length_m());
  for (const Leg& leg : {legs[0], legs[1]}) {
    if (left_m <= leg.length_m) return after(leg, left_m);
    left_m -= leg.length_m;
  }
  return after(legs[2], std::min(left_m, legs[2].length_m));
}

Turn shortest_turn(const Waypose& from, const Waypose& to, double radius_m) {
  const std::optional<Shape> shapes[] = {
      arc_line_arc(from, to, radius_m, 1, 1),  arc_line_arc(from, to, radius_m, -1, -1),
      arc_line_arc(from, to, radius_m, 1, -1), arc_line_arc(from, to, radius_m, -1, 1),
      arc_arc_arc(from, to, radius_m, 1),      arc_arc_arc(from, to, radius_m, -1),
  };
  Turn best;
  double best_m = std::numeric_limits<double>::infinity();
  for (const auto& shape : shapes) {
    if (!shape) continue;
    const Turn turn = turn_of(*shape, from, radius_m);
    if (turn.length_m() < best_m) {
      best = turn;
      best_m = turn.length_m();
    }
  }
  return best;
}

double follow_heading_rad(const Turn& turn, const Vec2& position_enu_m, double along_m, double lookahead_m) {
  const Waypose on_path = turn.at(along_m);
  const double cross_track_m = (position_enu_m - on_path.position_enu_m).dot(starboard(on_path.heading_rad));
  return frames::wrap_two_pi(on_path.heading_rad - std::atan2(cross_track_m, lookahead_m));
}

double nearest_along_m(const Turn& turn, const Vec2& position_enu_m, double from_m, double window_m, double step_m) {
  const int steps = static_cast<int>(window_m / step_m);
  double best_m = from_m, best_distance = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= steps; ++i) {
    const double along_m = from_m + i * step_m;
    if (along_m > turn.length_m()) break;
    const double distance = (turn.at(along_m).position_enu_m - position_enu_m).squaredNorm();
    if (distance < best_distance) {
      best_distance = distance;
      best_m = along_m;
    }
  }
  return best_m;
}

}  // namespace ensonify::runlines
