#include "kernels/vehicle/runlines/survey_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

namespace ensonify::runlines {
namespace {

constexpr std::size_t kMostCells = 512;  // along the longer side of the search lattice

/// The ground examined along a heading: cell (ahead, aside) counts from the rear port corner.
struct Lattice {
  Vec2 corner_enu_m;
  Vec2 forward, starboard;
  double cell_m = 1.0;
  std::size_t ahead = 0, aside = 0;
  std::vector<float> depth_m;  // below the head; NaN where no swath may lie

  Vec2 place_enu_m(double a, double s) const { return corner_enu_m + a * cell_m * forward + s * cell_m * starboard; }
  double depth(std::size_t a, std::size_t s) const { return depth_m[s * ahead + a]; }
};

/// Cells first..last (exclusive) of both axes.
struct Rectangle {
  std::size_t ahead_first = 0, ahead_last = 0, aside_first = 0, aside_last = 0;

  double ahead() const { return static_cast<double>(ahead_last - ahead_first); }
  double aside() const { return static_cast<double>(aside_last - aside_first); }
};

Lattice lattice_along(const HeightGrid& ground, const SurveyRequest& request, double heading) {
  Lattice lattice;
  lattice.forward = {std::sin(heading), std::cos(heading)};
  lattice.starboard = {std::cos(heading), -std::sin(heading)};
  const double half = 0.5 * ground.spacing_m;  // a post stands for the square around it
  const double west = ground.west_m - half, south = ground.south_m - half;
  const double east = west + ground.spacing_m * static_cast<double>(ground.columns);
  const double north = south + ground.spacing_m * static_cast<double>(ground.rows);
  double a0 = INFINITY, a1 = -INFINITY, s0 = INFINITY, s1 = -INFINITY;
  for (const Vec2& corner : {Vec2(west, south), Vec2(east, south), Vec2(west, north), Vec2(east, north)}) {
    const double a = corner.dot(lattice.forward), s = corner.dot(lattice.starboard);
    a0 = std::min(a0, a), a1 = std::max(a1, a), s0 = std::min(s0, s), s1 = std::max(s1, s);
  }
  lattice.cell_m = std::max(ground.spacing_m, std::max(a1 - a0, s1 - s0) / static_cast<double>(kMostCells));
  lattice.ahead = static_cast<std::size_t>(std::lround((a1 - a0) / lattice.cell_m));
  lattice.aside = static_cast<std::size_t>(std::lround((s1 - s0) / lattice.cell_m));
  lattice.corner_enu_m = a0 * lattice.forward + s0 * lattice.starboard;
  lattice.depth_m.resize(lattice.ahead * lattice.aside);
  for (std::size_t s = 0; s < lattice.aside; ++s) {
    for (std::size_t a = 0; a < lattice.ahead; ++a) {
      const Vec2 place = lattice.place_enu_m(static_cast<double>(a) + 0.5, static_cast<double>(s) + 0.5);
      const double depth = request.head_height_m - ground.nearest_height_m(place);
      lattice.depth_m[s * lattice.ahead + a] =
          depth >= request.least_water_m ? static_cast<float>(depth) : std::numeric_limits<float>::quiet_NaN();
    }
  }
  return lattice;
}

double median_depth_m(const Lattice& lattice) {
  std::vector<float> depths;
  for (const float depth : lattice.depth_m) {
    if (!std::isnan(depth)) depths.push_back(depth);
  }
  if (depths.empty()) return 0.0;
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return *middle;
}

/// The rectangle without holes of which a survey of at most `most_ahead` x `most_aside` cells can use most; among equal
/// ones the largest. Every maximal rectangle is found once: for each row, runs of free cells are the bars of a
/// histogram.
Rectangle best_rectangle(const Lattice& lattice, double most_ahead, double most_aside) {
  Rectangle best;
  double best_used = 0.0, best_area = 0.0;
  const auto consider = [&](const Rectangle& r) {
    const double used = std::min(r.ahead(), most_ahead) * std::min(r.aside(), most_aside);
    const double area = r.ahead() * r.aside();
    if (used > best_used || (used == best_used && area > best_area)) best = r, best_used = used, best_area = area;
  };
  struct Bar {
    std::size_t first, height;
  };
  std::vector<std::size_t> free_aside(lattice.ahead, 0);
  for (std::size_t s = 0; s < lattice.aside; ++s) {
    std::vector<Bar> open;
    for (std::size_t a = 0; a <= lattice.ahead; ++a) {
      std::size_t height = 0;
      if (a < lattice.ahead) height = free_aside[a] = std::isnan(lattice.depth(a, s)) ? 0 : free_aside[a] + 1;
      std::size_t first = a;
      while (!open.empty() && open.back().height >= height) {
        first = open.back().first;
        consider({first, a, s + 1 - open.back().height, s + 1});
        open.pop_back();
      }
      if (height > 0) open.push_back({first, height});
    }
  }
  return best;
}

/// The middle of a rectangle, at most so many cells long and wide.
Rectangle middle_of(const Rectangle& r, double ahead, double aside) {
  const auto trim = [](double have, double want) {
    return static_cast<std::size_t>(std::max(0.0, std::floor((have - want) / 2.0)));
  };
  const std::size_t a = trim(r.ahead(), ahead), s = trim(r.aside(), aside);
  return {r.ahead_first + a, r.ahead_last - a, r.aside_first + s, r.aside_last - s};
}

std::pair<double, double> depth_range_m(const Lattice& lattice, const Rectangle& r) {
  double least = INFINITY, greatest = 0.0;
  for (std::size_t s = r.aside_first; s < r.aside_last; ++s) {
    for (std::size_t a = r.ahead_first; a < r.ahead_last; ++a) {
      least = std::min(least, lattice.depth(a, s));
      greatest = std::max(greatest, lattice.depth(a, s));
    }
  }
  return {least, greatest};
}

std::string text_m(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0f m", metres);
  return text;
}

struct Attempt {
  SurveyPlan plan;  // without lines when there is no room
  double line_m = 0.0;
  std::string why;
};

Attempt attempt(const HeightGrid& ground, const SurveyRequest& request, double heading, double end_room_m) {
  const Lattice lattice = lattice_along(ground, request, heading);
  const double swath_per_depth = 2.0 * std::tan(0.5 * request.swath_rad);
  const auto spacing_over = [&](double depth_m) {
    return request.spacing_m.value_or(depth_m * swath_per_depth * (1.0 - request.overlap));
  };
  const double typical_m = median_depth_m(lattice);
  const double most_ahead = (request.longest_line_m + 2.0 * end_room_m) / lattice.cell_m;
  const double most_aside =
      ((request.most_lines - 1) * spacing_over(typical_m) + typical_m * swath_per_depth) / lattice.cell_m;
  const Rectangle free = best_rectangle(lattice, most_ahead, most_aside);
  const Rectangle used = middle_of(free, most_ahead, most_aside);

  Attempt result;
  if (free.ahead() == 0.0) {
    result.why = "no part of the chart is known and more than " + text_m(request.least_water_m) + " below the head";
    return result;
  }
  const auto [least_m, greatest_m] = depth_range_m(lattice, used);
  const double swath_m = greatest_m * swath_per_depth;
  const double length_m = free.ahead() * lattice.cell_m, width_m = free.aside() * lattice.cell_m;
  const double spacing_m = spacing_over(least_m);
  const double line_m = std::min(request.longest_line_m, length_m - 2.0 * end_room_m);
  const int count =
      width_m < swath_m ? 0 : std::min(request.most_lines, 1 + static_cast<int>((width_m - swath_m) / spacing_m));
  if (count == 0 || line_m < std::min(request.shortest_line_m, request.longest_line_m)) {
    result.why = "the largest area without holes is " + text_m(length_m) + " x " + text_m(width_m) +
                 "; one line needs " +
                 text_m(std::min(request.shortest_line_m, request.longest_line_m) + 2.0 * end_room_m) + " x " +
                 text_m(swath_m) + " (swath at " + text_m(greatest_m) + " below the head)";
    return result;
  }
  const Vec2 centre = lattice.place_enu_m(0.5 * static_cast<double>(free.ahead_first + free.ahead_last),
                                          0.5 * static_cast<double>(free.aside_first + free.aside_last));
  result.plan = {lawnmower(centre, heading, line_m, spacing_m, count), spacing_m, least_m, greatest_m};
  result.line_m = line_m;
  return result;
}

}  // namespace

double HeightGrid::nearest_height_m(const Vec2& place) const {
  const double column = std::round((place.x() - west_m) / spacing_m),
               row = std::round((place.y() - south_m) / spacing_m);
  if (!(column >= 0.0 && row >= 0.0 && column < static_cast<double>(columns) && row < static_cast<double>(rows))) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return height_m[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)];
}

SurveyPlan plan_survey(const HeightGrid& ground, const SurveyRequest& request) {
  std::vector<double> headings{0.5 * std::numbers::pi, 0.0};
  if (request.heading_rad) headings = {*request.heading_rad};
  std::string why;
  for (const double end_room_m : {std::max(request.turn_room_m, request.run_in_m), request.run_in_m}) {
    Attempt best;
    for (const double heading : headings) {
      Attempt now = attempt(ground, request, heading, end_room_m);
      const auto worth = [](const Attempt& a) { return a.line_m * static_cast<double>(a.plan.lines.size()); };
      if (best.plan.lines.empty() || worth(now) > worth(best)) best = std::move(now);
    }
    if (!best.plan.lines.empty()) return best.plan;
    why = best.why;
  }
  throw NoRoom(why);
}

}  // namespace ensonify::runlines
