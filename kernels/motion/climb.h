#pragma once

/// The quickest way from one height to another at rest, with limited speed and acceleration.
namespace ensonify::motion {

struct Climb {
  double height_m = 0.0;
  double speed_mps = 0.0;          // up
  double acceleration_mps2 = 0.0;  // up, in force from now on
};

/// Height and speed after dt on the way to `target_m`: full acceleration, then the highest speed, then full
/// deceleration, ending at rest at the target. A climb in the wrong direction, or too fast to stop in time, is braked
/// first and then comes back. Exact, so one step of dt equals any number of steps that sum to dt.
/// `fastest_mps` and `acceleration_mps2` must be above 0; an infinite acceleration changes speed at once.
Climb climb(const Climb& from, double target_m, double dt_s, double fastest_mps, double acceleration_mps2);

}  // namespace ensonify::motion
