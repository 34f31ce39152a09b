#pragma once

#include <span>
#include <vector>

/// Heave: the part of vertical motion that is faster than a cut-off. What is slower (draught, squat, load, tide) is
/// never in it. A motion sensor finds it by integrating vertical acceleration twice and letting go of what is slow.
namespace ensonify::sensors {

struct HeaveSettings {
  double cutoff_s = 20.0;   // > 0, period of the filter's corner ("heave period" of the setup page)
  double damping = 0.7071;  // > 0; 0.707: no resonance
};

/// The filter in time, sample by sample: H(s) of height, and of a wrong vertical acceleration what two integrations and
/// the filter leave of it, 1 / (s^2 + 2 z w s + w^2): a constant one leaves a constant error a / w^2, one that comes
/// and goes with a turn leaves a transient of the filter's period. Bilinear in time: right while samples come at
/// least 20 times per period of interest.
class HeaveFilter {
 public:
  explicit HeaveFilter(const HeaveSettings& settings) : settings_(settings) {}

  /// Heave dt (> 0) after the sample before. Height (positive up, any zero) of the point whose heave is wanted. The
  /// filter starts as if the height had always been the first one.
  double measure(double height_m, double acceleration_error_mps2, double dt_s);

 private:
  HeaveSettings settings_;
  bool started_ = false;
  double height_m_ = 0.0, error_mps2_ = 0.0;
  double heave_m_ = 0.0, rate_ = 0.0;  // rate: of heave, less what the height itself did
};

/// Delayed heave: the same corner without phase error, because it is computed once the future is known. Height less its
/// mean under a smooth symmetric window of length `window_s` either side (2.5 cut-off periods serve): the value at the
/// middle of `heights` (odd count, equal steps). Throws std::invalid_argument for an even count.
double delayed_heave_m(std::span<const double> heights_m, std::span<const double> window);

/// Weights of the slow part: a sinc that passes periods longer than the cut-off, tapered by Hann's window, sum 1.
std::vector<double> delayed_heave_window(double cutoff_s, double half_width_s, double step_s);

/// Level of a motion sensor: it assumes the mean specific force to be gravity. In a turn the mean
/// force leans outwards, and the sensor's level leans after it with its time constant; speed and heading wired in from
/// outside let it take off most of the turn.
struct LevelSettings {
  double time_s = 60.0;      // > 0, time constant with which level follows mean force
  double aided_share = 0.9;  // 0..1 of the turn's acceleration that is known and taken off
};

/// Effect of a turn on level, roll and vertical acceleration; zero on a straight course.
class LevelError {
 public:
  explicit LevelError(const LevelSettings& settings) : settings_(settings) {}

  /// dt after the sample before: acceleration across the course, positive to starboard (speed times turn rate). Gives
  /// the level's lean, rad: measured less true roll. It tends to -(1 - share) a / g.
  double advance(double across_mps2, double dt_s);

  /// Measured less true vertical acceleration (up) for the same moment: g (cos lean - 1) - a sin lean, whose first part
  /// is small of second order and whose second is felt because the leaning axis sees the turn.
  double vertical_error_mps2(double across_mps2) const;

 private:
  LevelSettings settings_;
  double lean_rad_ = 0.0;
};

}  // namespace ensonify::sensors
