#pragma once

#include <vector>

#include "kernels/base/frames/attitude.h"

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
  /// Depths rising; the first and the last stand beyond. Between them, in each direction of its own, the cubics that
  /// are monotone where the knots are [Fritsch1984]: knots are passed, nothing is beyond its neighbours, and velocity
  /// and shear are continuous, so that what dives through it has an acceleration everywhere. At the first and the last
  /// knot and where the current turns the shear is nothing; between two such knots it is at most 1.5 times the mean of
  /// theirs. Empty: none.
  std::vector<Knot> profile;
  std::vector<Stream> streams;

  bool none() const { return profile.empty() && streams.empty(); }
  /// It is not the same at all depths.
  bool sheared() const { return profile.size() > 1; }
  frames::Vec2 velocity_enu_mps(double depth_m, double t_s) const;
  /// Rate of its change for a body at a depth, going down at a speed.
  frames::Vec2 acceleration_enu_mps2(double depth_m, double sinking_mps, double t_s) const;
  /// Displacement of a body that stays at a depth, from t to t + dt.
  frames::Vec2 drift_enu_m(double depth_m, double t_s, double dt_s) const;
};

}  // namespace ensonify::motion
