#pragma once

#include <functional>
#include <span>

#include "kernels/acoustics/echo/image.h"
#include "kernels/acoustics/trace/scene.h"
#include "kernels/base/frames/pose.h"
#include "kernels/seabed/law.h"

namespace ensonify::physics {

/// A Mills cross of the kernels that heads are made of (rays, tiles, scatterers, beams with all their side lobes): two
/// uniform lines of elements, alike but for their direction, in isovelocity water. It receives sums of mean squares, so
/// levels without speckle.
struct MillsCross {
  int elements = 102;  // of each line; 1 degree
  double spacing_in_waves = 50.76 / 102;
  double source_level_db = 220.0;
  double absorption_dbpm = 0.0;
  double pulse_length_s = 100e-6;
  double sample_period_s = 25e-6;
  double range_m = 90.0;
  double half_swath_rad = 1.33;  // that rays go to; 76 degrees
  double quality = 1.0;          // of the rays

  double length_in_waves() const { return elements * spacing_in_waves; }
  /// b_T b_R of a beam in closed form.
  double two_way_power(double forward, double starboard, double sin_beam) const;

  /// Mean-square pressure, beam by sample (in the real part), uPa^2.
  echo::Image receive(const trace::Scene& seabed, const frames::HeadPose& head, const seabed::Law& backscatter,
                      std::span<const float> sin_beams) const;
};

inline constexpr double kSpeed_mps = 1500.0;

/// A square of seabed about the origin; NaN is a hole.
trace::Scene scene_of(double side_m, double spacing_m,
                      const std::function<double(double east, double north)>& height_m);

}  // namespace ensonify::physics
