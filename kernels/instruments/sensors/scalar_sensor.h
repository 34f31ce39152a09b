#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "kernels/base/frames/attitude.h"
#include "kernels/base/random/stream.h"

namespace ensonify::sensors {

/// Errors of a sensor of one quantity, in its unit. Zero switches an error off and moves no other draw.
struct ScalarErrors {
  double bias = 0.0;        // measured less true, as it is
  double bias_sigma = 0.0;  // standard deviation of a further bias that is drawn once
  double scale = 0.0;       // standard deviation, 1, drawn once
  double wander = 0.0;      // standard deviation of a Gauss-Markov error
  double wander_s = 300.0;  // > 0, its correlation time
  double white = 0.0;       // standard deviation of each sample's own error
  double resolution = 0.0;  // readings are multiples of it
  double lag_s = 0.0;       // first-order response: a step is followed with this time constant
};

/// A sensor of one quantity: pressure depth, altitude, sound speed, temperature, conductivity and their like.
class ScalarSensor {
 public:
  ScalarSensor(const ScalarErrors& errors, const random::Stream& stream);

  /// The reading dt after the one before it (the first: any dt >= 0). Exact for a true value that moved in a straight
  /// line, whatever the lag.
  double measure(double truth, double dt_s);

 private:
  ScalarErrors errors_;
  random::Stream stream_;
  random::GaussMarkov wander_;
  double response_ = 0.0, truth_ = 0.0;  // of the sensing element, and of the water, at the sample before
  std::uint64_t n_ = 0;
};

/// An altimeter: a single beam that reports distance, or nothing.
struct RangeErrors {
  double shortest_m = 0.3;
  double longest_m = 100.0;
  double dropout = 0.0;  // probability of no answer though the bottom is in range
};

class RangeSensor {
 public:
  RangeSensor(const RangeErrors& errors, const ScalarErrors& distance, const random::Stream& stream);

  /// dt after the sample before; `distance_m` is the true one along the beam, empty where there is nothing to receive.
  std::optional<double> measure(std::optional<double> distance_m, double dt_s);

 private:
  RangeErrors errors_;
  random::Stream stream_;
  ScalarSensor sensor_;
  double since_s_ = 0.0;  // the last answer
  std::uint64_t n_ = 0;
};

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
  Deviation deviation;               // magnetic: what is left after swinging the compass, as it is
  Deviation deviation_sigma;         // magnetic: standard deviations of further coefficients that are drawn once
  double variation_error_rad = 0.0;  // magnetic: declination entered less true
};

class HeadingSensor {
 public:
  /// Of the angle's errors (rad) scale is not used.
  HeadingSensor(const HeadingErrors& errors, const ScalarErrors& angle, const random::Stream& stream);

  /// Measured true heading, [0, 2 pi), dt after the sample before.
  double measure(double heading_rad, double speed_north_mps, double latitude_rad, double dt_s);

 private:
  HeadingErrors errors_;
  ScalarSensor sensor_;
  double unwrapped_rad_ = 0.0;  // the true heading without jumps, which the sensing element follows
};

}  // namespace ensonify::sensors
