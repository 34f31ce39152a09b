#include "kernels/instruments/sensors/scalar_sensor.h"

#include <algorithm>
#include <cmath>

namespace ensonify::sensors {
namespace {

enum Lane : std::uint64_t { kBias, kScale, kWander, kWhite };

}  // namespace

ScalarSensor::ScalarSensor(const ScalarErrors& errors, const random::Stream& stream)
    : errors_(errors), stream_(stream), wander_(errors.wander, errors.wander_s, stream, kWander) {}

double ScalarSensor::measure(double truth, double dt_s) {
  const bool first = n_++ == 0;
  if (first || errors_.lag_s <= 0.0) {
    response_ = truth;
  } else {
    // lag r' + r = true value, a ramp of this slope: r trails it by slope * lag once the start is forgotten.
    const double behind = dt_s > 0.0 ? (truth - truth_) / dt_s * errors_.lag_s : 0.0;
    response_ = truth - behind + (response_ - truth_ + behind) * std::exp(-dt_s / errors_.lag_s);
  }
  truth_ = truth;
  if (!first) wander_.advance(dt_s, stream_, n_, kWander);

  const double reading = response_ * (1.0 + errors_.scale * stream_.normal(0, kScale)) + errors_.bias +
                         errors_.bias_sigma * stream_.normal(0, kBias) + wander_.value() +
                         errors_.white * stream_.normal(n_, kWhite);
  return errors_.resolution > 0.0 ? errors_.resolution * std::round(reading / errors_.resolution) : reading;
}

RangeSensor::RangeSensor(const RangeErrors& errors, const ScalarErrors& distance, const random::Stream& stream)
    : errors_(errors), stream_(stream), sensor_(distance, stream) {}

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
