#pragma once

namespace ensonify::vertical {

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

}  // namespace ensonify::vertical
