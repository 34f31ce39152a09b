#pragma once

#include <cstdint>
#include <optional>

#include "kernels/instruments/sensors/scalar_sensor.h"

namespace ensonify::sensors {

/// An altimeter: a single beam that reports distance, or nothing.
struct RangeErrors {
  ScalarErrors range;  // m
  double shortest_m = 0.3;
  double longest_m = 100.0;
  double dropout = 0.0;  // probability of no answer though the bottom is in range

  bool operator==(const RangeErrors&) const = default;
};

class RangeSensor {
 public:
  RangeSensor(const RangeErrors& errors, const random::Stream& stream);

  /// dt after the sample before; `distance_m` is the true one along the beam, empty where there is nothing to receive.
  std::optional<double> measure(std::optional<double> distance_m, double dt_s);

 private:
  RangeErrors errors_;
  random::Stream stream_;
  ScalarSensor sensor_;
  double since_s_ = 0.0;  // the last answer
  std::uint64_t n_ = 0;
};

}  // namespace ensonify::sensors
