#pragma once

#include <vector>

#include "kernels/frames/attitude.h"

namespace ensonify::motion {

/// A current that is the same everywhere at one depth: a steady profile, and tidal streams that reach from the surface
/// to the bed alike. Horizontal.
struct Current {
  struct Knot {
    double depth_m = 0.0;  // below chart datum
    frames::Vec2 velocity_enu_mps = frames::Vec2::Zero();
  };
  struct Stream {
    frames::Vec2 amplitude_enu_mps = frames::Vec2::Zero();  // flood; the ebb is its opposite
    double speed_radps = 0.0;                               // of the tidal constituent
    double phase_rad = 0.0;                                 // by which the strongest flood lags the reference time
  };
  std::vector<Knot> profile;  // depths rising; straight lines between, the first and the last beyond. Empty: none
  std::vector<Stream> streams;

  bool none() const { return profile.empty() && streams.empty(); }
  frames::Vec2 velocity_enu_mps(double depth_m, double t_s) const;
  /// Its rate of change at a fixed depth.
  frames::Vec2 acceleration_enu_mps2(double t_s) const;
  /// How far it carries something that stays at a depth, from t to t + dt.
  frames::Vec2 drift_enu_m(double depth_m, double t_s, double dt_s) const;
};

}  // namespace ensonify::motion
