#pragma once

#include <vector>

/// Draught of a vessel.
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

/// Squat of a displacement vessel in open shallow water by Barrass, C_b v^2 / 100 with v in knots [Barrass2004]. For
/// depth / draught of 1.1 to 1.4 and block coefficients of 0.5 to 0.9; deeper water gives less.
double barrass_squat_m(double block_coefficient, double speed_mps);

}  // namespace ensonify::vertical
