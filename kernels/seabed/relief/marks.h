#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "kernels/base/frames/attitude.h"
#include "kernels/base/random/stream.h"
#include "kernels/seabed/relief/window.h"

namespace ensonify::relief {

/// A furrow that something was dragged along: an arc of a circle, or a straight line.
///
/// Across, with v the distance from the middle over the half width: -depth (1 - v^2)^2 within, and on each side a berm
/// spoil * depth * (4 w (1 - w))^2, w = v - 1, 0 < w < 1. The berms hold `spoil` of what the furrow lost (both areas
/// are 16/15 half widths times depth). Over the first and last tenth of its length a furrow fades in and out.
struct Mark {
  frames::Vec2 middle_enu_m;
  frames::Vec2 ahead_enu = frames::Vec2::UnitY();  // unit vector along it, at the middle
  double curvature_1pm = 0.0;                      // positive: turns to starboard
  double length_m = 0.0;
  double half_width_m = 0.0;
  double depth_m = 0.0;
  double spoil = 0.0;
};

/// Height of a mark at a place, m; 0 beyond its berms.
double height_at_m(const Mark& mark, const frames::Vec2& place_enu_m);

/// Its middle line, `points` places from end to end: the ground truth for who searches for marks.
std::vector<frames::Vec2> line_of(const Mark& mark, int points);

/// Whether the furrow, without its berms, hits a rectangle: some place of it is at most half the furrow's width from
/// the middle line, give or take a twentieth of that.
bool intersects(const Mark& mark, const frames::Vec2& south_west_enu_m, const frames::Vec2& north_east_enu_m);

/// Trawl scars (furrows in pairs, one per door) and anchor drags (single ones), a Poisson process of tracks. Known
/// of doors: 0.05-0.3 m deep, 1-4 m wide with berms, pairs 40-120 m apart, along contours.
struct MarkParameters {
  double tracks_per_km2 = 0.0;
  double length_m = 500.0;   // > 0
  double heading_rad = 0.0;  // mean, and how it varies between tracks
  double heading_sd_rad = 0.2;
  double curvature_sd_1pm = 3e-4;  // length * curvature is held below 1
  double least_spacing_m = 40.0;   // of a pair; both 0: single furrows
  double most_spacing_m = 120.0;
  double least_half_width_m = 0.5;  // > 0
  double most_half_width_m = 2.0;
  double depth_m = 0.2;  // when fresh
  double faded = 0.8;    // age: the share of its depth a track has lost is uniform from 0 to this
  double spoil = 0.5;    // 0 to 1
};

/// Rule for marks that cross: the one that departs most from the bottom is seen. At level k marks narrower than the
/// nodes are apart are not seen.
class Marks {
 public:
  Marks(const MarkParameters& parameters, double post_spacing_m, std::uint64_t seed, std::string_view name);

  /// Height above the undisturbed bottom, m.
  void fill(const Window& window, std::span<float> height_m) const;

  /// All marks that may reach into a rectangle.
  std::vector<Mark> within(const frames::Vec2& south_west_enu_m, const frames::Vec2& north_east_enu_m) const;

 private:
  void add_track(std::int64_t east, std::int64_t north, std::uint64_t number, std::vector<Mark>& marks) const;

  MarkParameters parameters_;
  double post_spacing_m_;
  double cell_m_ = 1.0, reach_m_ = 0.0;
  random::Stream noise_;
};

/// A list of given marks, for wrecks' and anchors' own tracks.
Field field_of(std::vector<Mark> marks, double post_spacing_m);

/// A dredged channel or a valley: within `half_width_m` of the line no higher than the line, whose ENU z is the
/// bottom's and is linear between its places; rising outside with `side_slope` (m per m). A ceiling: Seabed takes the
/// lower of it and the bottom. Throws std::invalid_argument below two places.
Field dredge_cut(std::vector<frames::Vec3> line_enu_m, double half_width_m, double side_slope, double post_spacing_m);

}  // namespace ensonify::relief
