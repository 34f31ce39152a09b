#include "kernels/seabed/relief/marks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "kernels/base/random/stream.h"
#include "kernels/seabed/relief/window.h"

namespace ensonify::relief {
namespace {

using frames::Vec2;

Vec2 starboard_of(const Vec2& ahead) { return {ahead.y(), -ahead.x()}; }

double fade(double along_m, double length_m) {
  const double from_end = std::clamp((0.5 * length_m - std::abs(along_m)) / (0.1 * length_m), 0.0, 1.0);
  return from_end * from_end * (3.0 - 2.0 * from_end);
}

double profile(double v, double spoil) {
  v = std::abs(v);
  if (v < 1.0) return -(1.0 - v * v) * (1.0 - v * v);
  if (v >= 2.0) return 0.0;
  const double w = v - 1.0, bump = 4.0 * w * (1.0 - w);
  return spoil * bump * bump;
}

double reach_of(const Mark& mark) { return 2.0 * mark.half_width_m; }

/// The nodes of a window within a box, as first and last columns and rows; empty where last < first.
struct Box {
  int west, east, south, north;
};

Box box_of(const Window& window, const Vec2& low, const Vec2& high, double post_spacing_m) {
  const Vec2 first = place_enu_m(window, 0, 0, post_spacing_m);
  const double step_m = node_spacing_m(post_spacing_m, window.level);
  const auto node = [&](double place, double origin, int count, bool up) {
    const double n = (place - origin) / step_m;
    return static_cast<int>(std::clamp(up ? std::ceil(n) : std::floor(n), -1.0, static_cast<double>(count)));
  };
  return {std::max(0, node(low.x(), first.x(), window.columns, false)),
          std::min(window.columns - 1, node(high.x(), first.x(), window.columns, true)),
          std::max(0, node(low.y(), first.y(), window.rows, false)),
          std::min(window.rows - 1, node(high.y(), first.y(), window.rows, true))};
}

/// Box by box along the mark: a node may be visited twice, which changes nothing.
void draw(const Mark& mark, const Window& window, double post_spacing_m, std::span<float> height_m) {
  const int pieces = std::max(1, static_cast<int>(std::ceil(mark.length_m / (8.0 * reach_of(mark)))));
  const std::vector<Vec2> line = line_of(mark, pieces + 1);
  // An arc leaves its chord by less than an eighth of the piece for the curvatures in use.
  const double margin_m = reach_of(mark) + 0.125 * mark.length_m / pieces;
  for (std::size_t p = 0; p + 1 < line.size(); ++p) {
    const Vec2 low = line[p].cwiseMin(line[p + 1]).array() - margin_m,
               high = line[p].cwiseMax(line[p + 1]).array() + margin_m;
    const Box box = box_of(window, low, high, post_spacing_m);
    for (int j = box.south; j <= box.north; ++j) {
      for (int i = box.west; i <= box.east; ++i) {
        const auto z = static_cast<float>(height_at_m(mark, place_enu_m(window, i, j, post_spacing_m)));
        float& seen = height_m[window.node(i, j)];
        if (std::abs(z) > std::abs(seen) || (z == -seen && z < 0.0F)) seen = z;
      }
    }
  }
}

void draw_all(const std::vector<Mark>& marks, const Window& window, double post_spacing_m, std::span<float> height_m) {
  std::fill(height_m.begin(), height_m.end(), 0.0F);
  for (const Mark& mark : marks) {
    if (window.level > 0 && 2.0 * mark.half_width_m < node_spacing_m(post_spacing_m, window.level)) continue;
    draw(mark, window, post_spacing_m, height_m);
  }
}

}  // namespace

double height_at_m(const Mark& mark, const Vec2& place_enu_m) {
  const Vec2 offset = place_enu_m - mark.middle_enu_m;
  const double ahead_m = offset.dot(mark.ahead_enu), starboard_m = offset.dot(starboard_of(mark.ahead_enu));
  double along_m = ahead_m, across_m = starboard_m;
  if (std::abs(mark.curvature_1pm) > 1e-9) {
    const double radius_m = 1.0 / std::abs(mark.curvature_1pm);
    const double to_centre_m = radius_m - std::copysign(starboard_m, starboard_m * mark.curvature_1pm);
    across_m = std::hypot(ahead_m, to_centre_m) - radius_m;
    if (std::abs(across_m) >= reach_of(mark)) return 0.0;
    along_m = radius_m * std::atan2(ahead_m, to_centre_m);
  }
  if (std::abs(across_m) >= reach_of(mark) || 2.0 * std::abs(along_m) >= mark.length_m) return 0.0;
  return mark.depth_m * fade(along_m, mark.length_m) * profile(across_m / mark.half_width_m, mark.spoil);
}

std::vector<Vec2> line_of(const Mark& mark, int points) {
  const Vec2 starboard = starboard_of(mark.ahead_enu);
  std::vector<Vec2> line;
  for (int p = 0; p < points; ++p) {
    const double s = mark.length_m * (static_cast<double>(p) / (points - 1) - 0.5), turn = s * mark.curvature_1pm;
    const bool straight = std::abs(turn) < 1e-9;
    const double a = straight ? s : std::sin(turn) / mark.curvature_1pm;
    const double b = straight ? 0.0 : (1.0 - std::cos(turn)) / mark.curvature_1pm;
    line.push_back(mark.middle_enu_m + a * mark.ahead_enu + b * starboard);
  }
  return line;
}

bool intersects(const Mark& mark, const Vec2& south_west_enu_m, const Vec2& north_east_enu_m) {
  const Eigen::AlignedBox2d box(south_west_enu_m, north_east_enu_m);
  if (box.contains(mark.middle_enu_m)) return true;
  if (box.exteriorDistance(mark.middle_enu_m) > 0.5 * mark.length_m + mark.half_width_m) return false;
  const int steps = std::max(1, static_cast<int>(std::ceil(mark.length_m / (0.1 * mark.half_width_m))));
  const std::vector<Vec2> line = line_of(mark, steps + 1);
  return std::any_of(line.begin(), line.end(),
                     [&](const Vec2& place) { return box.exteriorDistance(place) <= mark.half_width_m; });
}

Marks::Marks(const MarkParameters& parameters, double post_spacing_m, std::uint64_t seed, std::string_view name)
    : parameters_(parameters), post_spacing_m_(post_spacing_m), noise_(seed, name) {
  const MarkParameters& p = parameters_;
  if (!(p.tracks_per_km2 >= 0.0 && p.length_m > 0.0 && p.heading_sd_rad >= 0.0 && p.curvature_sd_1pm >= 0.0 &&
        p.least_spacing_m >= 0.0 && p.most_spacing_m >= p.least_spacing_m && p.least_half_width_m > 0.0 &&
        p.most_half_width_m >= p.least_half_width_m && p.depth_m >= 0.0 && p.faded >= 0.0 && p.faded <= 1.0 &&
        p.spoil >= 0.0 && p.spoil <= 1.0 && post_spacing_m > 0.0)) {
    throw std::invalid_argument(
        "marks: allowed are tracks_per_km2, spreads, spacings and depth of 0 or more, length and half widths above 0, "
        "least not above most, faded and spoil 0 to 1");
  }
  cell_m_ = std::max(p.length_m, std::sqrt(1e6 / std::max(p.tracks_per_km2, 1e-3)));
  reach_m_ = 0.5 * p.length_m + 0.5 * p.most_spacing_m + 2.0 * p.most_half_width_m;
}

void Marks::add_track(std::int64_t east, std::int64_t north, std::uint64_t number, std::vector<Mark>& marks) const {
  const MarkParameters& p = parameters_;
  const auto x = static_cast<std::uint64_t>(east), y = static_cast<std::uint64_t>(north);
  const auto place = noise_.bits(x, y, 4 * number + 1), size = noise_.bits(x, y, 4 * number + 2);
  const auto turn = noise_.normal_pair(x, y, 4 * number + 3);
  Mark track;
  const double heading_rad = p.heading_rad + p.heading_sd_rad * turn[0];
  track.ahead_enu = {std::sin(heading_rad), std::cos(heading_rad)};
  const double most = 1.0 / p.length_m;
  track.curvature_1pm = std::clamp(p.curvature_sd_1pm * turn[1], -most, most);
  track.length_m = p.length_m;
  track.half_width_m = std::lerp(p.least_half_width_m, p.most_half_width_m, size[0] * 0x1p-32);
  track.depth_m = p.depth_m * (1.0 - p.faded * size[1] * 0x1p-32);
  track.spoil = p.spoil;
  const Vec2 middle((static_cast<double>(east) + place[0] * 0x1p-32) * cell_m_,
                    (static_cast<double>(north) + place[1] * 0x1p-32) * cell_m_);
  const double spacing_m = std::lerp(p.least_spacing_m, p.most_spacing_m, place[2] * 0x1p-32);
  for (const double side : {-0.5, 0.5}) {
    track.middle_enu_m = middle + side * spacing_m * starboard_of(track.ahead_enu);
    marks.push_back(track);
    if (spacing_m == 0.0) break;
  }
}

std::vector<Mark> Marks::within(const Vec2& south_west_enu_m, const Vec2& north_east_enu_m) const {
  std::vector<Mark> marks;
  if (parameters_.tracks_per_km2 == 0.0) return marks;
  const double per_cell = parameters_.tracks_per_km2 * 1e-6 * cell_m_ * cell_m_;
  const auto cell = [&](double place) { return static_cast<std::int64_t>(std::floor(place / cell_m_)); };
  for (std::int64_t north = cell(south_west_enu_m.y() - reach_m_); north <= cell(north_east_enu_m.y() + reach_m_);
       ++north) {
    for (std::int64_t east = cell(south_west_enu_m.x() - reach_m_); east <= cell(north_east_enu_m.x() + reach_m_);
         ++east) {
      const int count = random::poisson(
          per_cell, noise_.uniform(static_cast<std::uint64_t>(east), static_cast<std::uint64_t>(north), 0));
      for (int n = 0; n < count; ++n) add_track(east, north, static_cast<std::uint64_t>(n), marks);
    }
  }
  return marks;
}

void Marks::fill(const Window& window, std::span<float> height_m) const {
  const Vec2 first = place_enu_m(window, 0, 0, post_spacing_m_),
             last = place_enu_m(window, window.columns - 1, window.rows - 1, post_spacing_m_);
  draw_all(within(first, last), window, post_spacing_m_, height_m);
}

Field field_of(std::vector<Mark> marks, double post_spacing_m) {
  return [marks = std::move(marks), post_spacing_m](const Window& window, std::span<float> height_m) {
    draw_all(marks, window, post_spacing_m, height_m);
  };
}

Field dredge_cut(std::vector<frames::Vec3> line_enu_m, double half_width_m, double side_slope, double post_spacing_m) {
  if (line_enu_m.size() < 2 || !(half_width_m > 0.0 && side_slope > 0.0))
    throw std::invalid_argument("dredge cut: allowed are two places or more, a half width and a side slope above 0");
  return [line = std::move(line_enu_m), half_width_m, side_slope, post_spacing_m](const Window& window,
                                                                                  std::span<float> height_m) {
    for (int j = 0; j < window.rows; ++j) {
      for (int i = 0; i < window.columns; ++i) {
        const Vec2 place = place_enu_m(window, i, j, post_spacing_m);
        double lowest_m = std::numeric_limits<double>::infinity();
        for (std::size_t p = 0; p + 1 < line.size(); ++p) {
          const Vec2 start = line[p].head<2>(), end = line[p + 1].head<2>();
          const double along = along_segment(place, start, end);
          const double outside_m = (place - start - along * (end - start)).norm() - half_width_m;
          lowest_m = std::min(lowest_m,
                              std::lerp(line[p].z(), line[p + 1].z(), along) + side_slope * std::max(0.0, outside_m));
        }
        height_m[window.node(i, j)] = static_cast<float>(lowest_m);
      }
    }
  };
}

}  // namespace ensonify::relief
