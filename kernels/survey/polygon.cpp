#include "kernels/survey/polygon.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
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

}  // namespace ensonify::survey
