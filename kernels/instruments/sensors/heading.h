#pragma once

#include <array>
#include <cstdint>

#include "kernels/base/frames/attitude.h"
#include "kernels/instruments/sensors/scalar_sensor.h"

namespace ensonify::sensors {

/// Deviation of a magnetic compass by heading, in the navigator's letters [Bowditch, ch. 6]: A + B sin h + C cos h +
/// D sin 2h + E cos 2h, added to what the compass should read. rad.
struct Deviation {
  std::array<double, 5> abcde_rad{};

  double at(double heading_rad) const;
};

/// A gyrocompass or satellite compass: speed and course error of one that seeks north by pendulum, if it is not
/// corrected for speed: tan error = -v cos course / (R w cos latitude) [Bowditch, ch. 6], westerly when going north.
double steaming_error_rad(double speed_north_mps, double latitude_rad);

enum class HeadingKind { kGyro, kMagnetic };

struct HeadingErrors {
  HeadingKind kind = HeadingKind::kGyro;
  bool speed_corrected = true;       // gyro: steaming error is taken off
  Deviation deviation;               // magnetic: what is left after swinging the compass
  double variation_error_rad = 0.0;  // magnetic: declination entered less true
};

class HeadingSensor {
 public:
  /// Of the angle's errors (rad) scale is not used.
  HeadingSensor(const HeadingErrors& errors, const ScalarErrors& angle, const random::Stream& stream)
      : errors_(errors), sensor_(angle, stream) {}

  /// Measured true heading, [0, 2 pi), dt after the sample before.
  double measure(double heading_rad, double speed_north_mps, double latitude_rad, double dt_s);

 private:
  HeadingErrors errors_;
  ScalarSensor sensor_;
  double unwrapped_rad_ = 0.0;  // the true heading without jumps, which the sensing element follows
};

}  // namespace ensonify::sensors
