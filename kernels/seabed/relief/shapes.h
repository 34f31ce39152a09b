#pragma once

#include "kernels/base/frames/attitude.h"
#include "kernels/seabed/relief/window.h"

namespace ensonify::relief {

/// Macro shapes with closed forms, as bases to lay layers on or as worlds of their own in tests. Places are ENU m from
/// the scenario's origin, heights ENU z, m. All throw std::invalid_argument for sizes that must be positive and are
/// not.

/// A tilted plane, `slope` (m per m) deeper towards `downhill_heading_rad`.
struct Plane {
  double depth_m = 20.0;  // at the origin, positive down
  double slope = 0.0;
  double downhill_heading_rad = 0.0;
};
Field plane(const Plane& shape, double post_spacing_m);

/// Level on both sides of a straight ramp: `depth_m` before it, `depth_m + drop_m` after it, walking along
/// `heading_rad` through `middle_enu_m`. run_m 0 is a step: the sharpest that posts can show.
struct Ramp {
  frames::Vec2 middle_enu_m = frames::Vec2::Zero();
  double heading_rad = 0.0;
  double depth_m = 20.0;
  double drop_m = 2.0;
  double run_m = 0.0;  // >= 0
};
Field ramp(const Ramp& shape, double post_spacing_m);

/// A wave depth_m - amplitude_m * cos(2 pi distance / wavelength) along a heading: troughs are deep, a crest at the
/// origin.
struct Wave {
  double depth_m = 20.0;
  double amplitude_m = 1.0;
  double wavelength_m = 20.0;  // > 0
  double heading_rad = 0.0;
};
Field wave(const Wave& shape, double post_spacing_m);

/// The part of a sphere above a level bottom.
struct Sphere {
  frames::Vec2 centre_enu_m = frames::Vec2::Zero();
  double centre_depth_m = 20.0;
  double radius_m = 1.0;  // > 0
  double depth_m = 20.0;  // of the bottom
};
Field sphere(const Sphere& shape, double post_spacing_m);

/// A ridge upon the bottom: Gaussian across, level along its line, falling off as a Gaussian of the same width beyond
/// its ends. Its height above the bottom, m.
struct Ridge {
  frames::Vec2 start_enu_m = frames::Vec2::Zero();
  frames::Vec2 end_enu_m = frames::Vec2::Zero();
  double height_m = 1.0;
  double width_m = 20.0;  // > 0, full width at half height
};
Field ridge(const Ridge& shape, double post_spacing_m);

}  // namespace ensonify::relief
