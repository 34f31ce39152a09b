#pragma once

namespace ensonify::sensors {

/// Level of a motion sensor: it assumes the mean specific force to be gravity. In a turn the mean
/// force leans outwards, and the sensor's level leans after it with its time constant; speed and heading wired in from
/// outside let it take off most of the turn.
struct LevelSettings {
  double time_s = 60.0;      // > 0, time constant with which level follows mean force
  double aided_share = 0.9;  // 0..1 of the turn's acceleration that is known and taken off

  bool operator==(const LevelSettings&) const = default;
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
