#pragma once

#include <optional>
#include <vector>

#include "kernels/vehicle/vertical/tide.h"

/// Draught of a vessel, and the height at which she floats.
namespace ensonify::vertical {

/// A vessel's settlement and squat at one speed: how much deeper her reference point runs than at rest.
struct Sinkage {
  double speed_mps = 0.0;
  double lower_m = 0.0;  // positive down
};

struct Loading {
  /// Settlement and squat as measured, speeds rising from 0; straight lines between, the last beyond. Empty: none.
  std::vector<Sinkage> settlement;
  double change_m = 0.0;  // deeper by this than the reference point's own waterline, at sim time 0
  double rate_mps = 0.0;  // deeper with time; burnt fuel makes it negative
};

/// Increase of depth over rest and first load, positive down, at a speed through the water and sim time t.
double sinkage_m(const Loading& loading, double speed_mps, double t_s);

/// Approach of a hull to the settlement of its speed: like a critically damped mass on a spring, z'' = w^2 (u - z) - 2
/// w z' with w = 1/s (assumed; nine tenths of a sudden change after 4 s). So neither its velocity nor its acceleration
/// has steps where a ramp of speed begins or ends, and each is the derivative of the one before. Exact for a u that
/// changes uniformly within a step.
class Settling {
 public:
  Settling() = default;
  /// At rest at `lower_m`, positive down.
  explicit Settling(double lower_m) : target_m_(lower_m), lower_m_(lower_m) {}

  /// dt later (>= 0), when the settlement of the speed has come to `target_m`.
  void advance(double target_m, double dt_s);

  double lower_m() const { return lower_m_; }
  double rate_mps() const { return rate_mps_; }
  double acceleration_mps2() const;

 private:
  double target_m_ = 0.0;
  double lower_m_ = 0.0;
  double rate_mps_ = 0.0;
};

/// Height at which a vessel floats: on the tide, less the settlement of her speed, as the hull comes to it, and what
/// her load changes. Without a loading it is the tide's own level, which a submerged vehicle rides.
class Floating {
 public:
  /// Settled to its speed through the water at sim time `t_s`.
  Floating(const Tide& tide, const std::optional<Loading>& loading, double speed_mps, double t_s);

  /// On to `t_s` (not before the last), when the speed through the water has come to `speed_mps`.
  void advance(double speed_mps, double t_s);

  Level at_last() const;

 private:
  double settlement_m(double speed_mps) const;

  Tide tide_;
  std::optional<Loading> loading_;
  Settling settling_;
  double t_s_;
};

}  // namespace ensonify::vertical
