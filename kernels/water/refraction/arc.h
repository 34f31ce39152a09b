#pragma once

#include <algorithm>
#include <cmath>

namespace ensonify::refraction {

// Functions over their argument, 1 at zero; series where digits would be lost, neglected terms below 1e-13.

// The series, which nearly every leg takes, are small enough to be compiled into their callers.

[[gnu::noinline]] inline double asin_over_large(double v) { return std::asin(std::clamp(v, -1.0, 1.0)) / v; }
[[gnu::noinline]] inline double asinh_over_large(double u) { return std::asinh(u) / u; }

inline double asin_over(double v) {
  const double v2 = v * v;
  return v2 < 1e-4 ? 1.0 + v2 * (1.0 / 6 + v2 * (3.0 / 40)) : asin_over_large(v);
}
inline double asinh_over(double u) {
  const double u2 = u * u;
  return u2 < 1e-4 ? 1.0 - u2 * (1.0 / 6 - u2 * (3.0 / 40)) : asinh_over_large(u);
}
inline double sinh_over(double u) { return std::abs(u) < 1e-3 ? 1.0 + u * u / 6 : std::sinh(u) / u; }

/// Length of a circular arc over its chord.
inline double arc_m(double curvature_pm, double chord_m) { return chord_m * asin_over(0.5 * curvature_pm * chord_m); }

/// Travel time between two points of a medium with a linear gradient of speed: (2/g) arsinh(g L / (2 sqrt(c1 c2))).
inline double arc_s(double gradient_per_s, double chord_m, double speed_1_mps, double speed_2_mps) {
  const double mean = 1.0 / (speed_1_mps + speed_2_mps), part = mean * (speed_2_mps - speed_1_mps), e = part * part;
  const double slowness =  // 1 / sqrt(c1 c2) = 1 / (mean speed sqrt(1 - e))
      e < 1e-5 ? 2.0 * mean * (1.0 + e * (0.5 + 0.375 * e)) : 1.0 / std::sqrt(speed_1_mps * speed_2_mps);
  return chord_m * slowness * asinh_over(0.5 * gradient_per_s * chord_m * slowness);
}

}  // namespace ensonify::refraction
