#include "kernels/survey/lines.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace ensonify::survey {
namespace {

/// > 0: c lies to port of the way from a to b; 0: on its line.
double side_of(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// Whether two sides, ends included, have a place in common.
bool intersect(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto apart = [](double s, double t) { return (s > 0.0 && t > 0.0) || (s < 0.0 && t < 0.0); };
  if (apart(side_of(a, b, c), side_of(a, b, d)) || apart(side_of(c, d, a), side_of(c, d, b))) return false;
  const auto beside = [](double a0, double a1, double b0, double b1) {
    return std::max(a0, a1) < std::min(b0, b1) || std::max(b0, b1) < std::min(a0, a1);
  };
  return !beside(a.x(), b.x(), c.x(), d.x()) && !beside(a.y(), b.y(), c.y(), d.y());
}

/// Two sides, by the corner where each begins, that intersect elsewhere than in a corner between them. Sides of no
/// length do not count: the first corner may be given again at the end.
std::optional<std::pair<std::size_t, std::size_t>> crossing_sides(const Polygon& area) {
  const auto end = [&](std::size_t side) -> const Vec2& { return area[(side + 1) % area.size()]; };
  std::vector<std::size_t> sides;
  for (std::size_t i = 0; i < area.size(); ++i) {
    if (area[i] != end(i)) sides.push_back(i);
  }
  for (std::size_t i = 0; i < sides.size(); ++i) {
    for (std::size_t k = i + 1; k < sides.size(); ++k) {
      const std::size_t s = sides[i], t = sides[k];
      const bool next = k == i + 1, last = i == 0 && k + 1 == sides.size();
      const bool doubles_back = side_of(area[s], end(s), end(t)) == 0.0 && side_of(area[s], end(s), area[t]) == 0.0 &&
                                (end(s) - area[s]).dot(end(t) - area[t]) < 0.0;
      if (next || last ? doubles_back : intersect(area[s], end(s), area[t], end(t))) return std::pair{s, t};
    }
  }
  return std::nullopt;
}

constexpr std::size_t kMostLines = 10000;

/// The area seen along the lines: x ahead, y to starboard.
struct Turned {
  Vec2 forward, starboard;
  Polygon corners;
  double rear_m = INFINITY, front_m = -INFINITY, port_m = INFINITY, right_m = -INFINITY;

  Vec2 enu_m(double ahead_m, double across_m) const { return ahead_m * forward + across_m * starboard; }
};

Turned turned(const Polygon& area, double heading_rad) {
  check_simple(area);
  Turned t;
  t.forward = {std::sin(heading_rad), std::cos(heading_rad)};
  t.starboard = {t.forward.y(), -t.forward.x()};
  for (const Vec2& corner : area) {
    const Vec2 c(corner.dot(t.forward), corner.dot(t.starboard));
    t.corners.push_back(c);
    t.rear_m = std::min(t.rear_m, c.x()), t.front_m = std::max(t.front_m, c.x());
    t.port_m = std::min(t.port_m, c.y()), t.right_m = std::max(t.right_m, c.y());
  }
  return t;
}

/// Where the area begins and ends along a line, in pairs.
std::vector<double> crossings(const Turned& area, double across_m) {
  std::vector<double> ahead_m;
  for (std::size_t i = 0; i < area.corners.size(); ++i) {
    const Vec2& a = area.corners[i];
    const Vec2& b = area.corners[(i + 1) % area.corners.size()];
    if ((a.y() <= across_m) == (b.y() <= across_m)) continue;
    ahead_m.push_back(a.x() + (b.x() - a.x()) * (across_m - a.y()) / (b.y() - a.y()));
  }
  std::sort(ahead_m.begin(), ahead_m.end());
  return ahead_m;
}

std::vector<Runline> clipped(const Turned& area, const std::vector<double>& across_m, double shortest_m) {
  std::vector<Runline> lines;
  bool up = true;
  for (const double y : across_m) {
    const std::vector<double> ends = crossings(area, y);
    std::vector<Runline> pieces;
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
      if (ends[i + 1] - ends[i] < shortest_m) continue;
      pieces.push_back({area.enu_m(ends[i], y), area.enu_m(ends[i + 1], y)});
    }
    if (pieces.empty()) continue;
    if (!up) {
      std::reverse(pieces.begin(), pieces.end());
      for (Runline& piece : pieces) piece = runlines::reversed(piece);
    }
    lines.insert(lines.end(), pieces.begin(), pieces.end());
    up = !up;
  }
  return lines;
}

class Bottom {
 public:
  Bottom(const Turned& area, const DepthAt& depth, const LayRules& rules) : area_(area), depth_(depth), rules_(rules) {}

  double depth_m(double ahead_m, double across_m) const {
    const Vec2 at = area_.enu_m(ahead_m, std::min(across_m, area_.right_m));
    const double depth_m = depth_(at);
    if (!(depth_m > 0.0)) {
      char text[160];
      if (std::isnan(depth_m)) {
        std::snprintf(
            text, sizeof text,
            "(%.1f, %.1f) m lies outside the terrain; allowed: an area whose rectangle along the lines lies on it",
            at.x(), at.y());
      } else {
        std::snprintf(text, sizeof text, "the depth below the head at (%.1f, %.1f) m is %g m; allowed: above 0", at.x(),
                      at.y(), depth_m);
      }
      throw std::invalid_argument(text);
    }
    return depth_m;
  }

  /// Where the outermost beam of a head at (ahead, across) hits the bottom to starboard: steps out until the beam is
  /// below it, then halves.
  double reached_m(double ahead_m, double across_m) const {
    const double tangent = std::tan(rules_.swath.half_angle_rad);
    const auto above = [&](double x_m) { return x_m < tangent * depth_m(ahead_m, across_m + x_m); };
    const double step_m = 0.1 * tangent * depth_m(ahead_m, across_m);
    double in_m = 0.0, out_m = step_m;
    while (above(out_m) && across_m + out_m < area_.right_m) in_m = out_m, out_m += step_m;
    for (int i = 0; i < 30; ++i) {
      const double middle_m = 0.5 * (in_m + out_m);
      (above(middle_m) ? in_m : out_m) = middle_m;
    }
    return across_m + in_m;
  }

  /// Rows along the survey at which the area is crossed at all.
  std::vector<double> rows_m() const {
    const int count = std::max(1, static_cast<int>(std::lround((area_.front_m - area_.rear_m) / rules_.row_m)));
    std::vector<double> rows;
    for (int i = 0; i < count; ++i) rows.push_back(area_.rear_m + (i + 0.5) * (area_.front_m - area_.rear_m) / count);
    return rows;
  }

 private:
  const Turned& area_;
  const DepthAt& depth_;
  const LayRules& rules_;
};

void check_count(std::size_t count) {
  if (count > kMostLines) throw std::invalid_argument("the area would take more than 10000 lines");
}

}  // namespace

double area_m2(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i] - polygon[0], b = polygon[(i + 1) % polygon.size()] - polygon[0];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return 0.5 * std::abs(twice);
}

void check_simple(const Polygon& area) {
  if (area.size() < 3) throw std::invalid_argument("an area has at least 3 corners");
  const auto other = std::find_if(area.begin(), area.end(), [&](const Vec2& corner) { return corner != area[0]; });
  if (std::all_of(other, area.end(), [&](const Vec2& corner) { return side_of(area[0], *other, corner) == 0.0; })) {
    throw std::invalid_argument("the area is empty: its corners lie on one line");
  }
  if (const auto sides = crossing_sides(area)) {
    const Vec2 &a = area[sides->first], &b = area[sides->second];
    char text[240];
    std::snprintf(
        text, sizeof text,
        "the area crosses itself: the side from corner %zu (%g, %g) crosses the one from corner %zu (%g, %g); "
        "allowed: corners in order round it",
        sides->first + 1, a.x(), a.y(), sides->second + 1, b.x(), b.y());
    throw std::invalid_argument(text);
  }
}

std::vector<Runline> adapted_lines(const Polygon& polygon, const DepthAt& depth, const LayRules& rules) {
  const Turned area = turned(polygon, rules.heading_rad);
  const Bottom bottom(area, depth, rules);
  std::vector<CoveredEdge> edges;
  const std::vector<double> rows = bottom.rows_m();
  for (const double row : rows) edges.push_back({area.port_m, bottom.depth_m(row, area.port_m)});
  std::vector<double> across_m;
  const auto covered = [&](const CoveredEdge& edge) { return edge.across_m >= area.right_m; };
  while (!std::all_of(edges.begin(), edges.end(), covered)) {
    std::vector<CoveredEdge> open;
    std::copy_if(edges.begin(), edges.end(), std::back_inserter(open), [&](const auto& e) { return !covered(e); });
    across_m.push_back(next_line_across_m(open, rules.swath, area.right_m));
    check_count(across_m.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      edges[i].across_m = std::max(edges[i].across_m, bottom.reached_m(rows[i], across_m.back()));
      edges[i].depth_m = bottom.depth_m(rows[i], edges[i].across_m);
    }
  }
  return clipped(area, across_m, rules.shortest_line_m);
}

std::vector<Runline> fixed_lines(const Polygon& polygon, const DepthAt& depth, const LayRules& rules) {
  const Turned area = turned(polygon, rules.heading_rad);
  const Bottom bottom(area, depth, rules);
  double shallowest_m = std::numeric_limits<double>::infinity();
  for (const double row : bottom.rows_m()) {
    for (double across_m = area.port_m; across_m <= area.right_m; across_m += rules.row_m) {
      shallowest_m = std::min(shallowest_m, bottom.depth_m(row, across_m));
    }
  }
  return spaced_lines(polygon, (2.0 - rules.swath.overlap) * shallowest_m * std::tan(rules.swath.half_angle_rad),
                      rules);
}

std::vector<Runline> spaced_lines(const Polygon& polygon, double spacing_m, const LayRules& rules) {
  if (!(spacing_m > 0.0)) throw std::invalid_argument("the distance between lines must be above 0");
  const Turned area = turned(polygon, rules.heading_rad);
  const double count = std::ceil((area.right_m - area.port_m) / spacing_m - 1e-9);
  check_count(static_cast<std::size_t>(std::min(count, 1e9)));
  std::vector<double> across_m;
  for (int i = 0; i < static_cast<int>(count); ++i) {
    across_m.push_back(area.port_m + (i + 0.5) * (area.right_m - area.port_m) / count);
  }
  return clipped(area, across_m, rules.shortest_line_m);
}

}  // namespace ensonify::survey
