#include "kernels/instruments/sensors/range_sensor.h"

#include <algorithm>

namespace ensonify::sensors {

RangeSensor::RangeSensor(const RangeErrors& errors, const random::Stream& stream)
    : errors_(errors), stream_(stream), sensor_(errors.range, stream) {}

std::optional<double> RangeSensor::measure(std::optional<double> distance_m, double dt_s) {
  constexpr std::uint64_t kDropout = 16;  // a lane of its own; ScalarSensor has the first ones
  ++n_;
  since_s_ += dt_s;
  if (!distance_m || *distance_m < errors_.shortest_m || *distance_m > errors_.longest_m) return std::nullopt;
  if (stream_.uniform(n_, kDropout) < errors_.dropout) return std::nullopt;
  const double reading = sensor_.measure(*distance_m, since_s_);
  since_s_ = 0.0;
  return std::max(reading, 0.0);
}

}  // namespace ensonify::sensors
