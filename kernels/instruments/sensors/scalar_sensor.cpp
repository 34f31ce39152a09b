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

double Deviation::at(double heading_rad) const {
  const auto& [a_rad, b_rad, c_rad, d_rad, e_rad] = abcde_rad;
  return a_rad + b_rad * std::sin(heading_rad) + c_rad * std::cos(heading_rad) + d_rad * std::sin(2.0 * heading_rad) +
         e_rad * std::cos(2.0 * heading_rad);
}

double steaming_error_rad(double speed_north_mps, double latitude_rad) {
  constexpr double kEarthSpeed_mps = 6378137.0 * 7.292115e-5;  // of the ground at the equator
  return -std::atan2(speed_north_mps, kEarthSpeed_mps * std::cos(latitude_rad));
}

HeadingSensor::HeadingSensor(const HeadingErrors& errors, const ScalarErrors& angle, const random::Stream& stream)
    : errors_(errors), sensor_(angle, stream) {
  constexpr std::uint64_t kDeviation = 16;  // lanes of their own; ScalarSensor has the first ones
  for (std::uint64_t i = 0; i < errors_.deviation.abcde_rad.size(); ++i) {
    errors_.deviation.abcde_rad[i] += errors.deviation_sigma.abcde_rad[i] * stream.normal(0, kDeviation + i);
  }
}

double HeadingSensor::measure(double heading_rad, double speed_north_mps, double latitude_rad, double dt_s) {
  unwrapped_rad_ += frames::wrap_pi(heading_rad - unwrapped_rad_);
  double reading = sensor_.measure(unwrapped_rad_, dt_s);
  if (errors_.kind == HeadingKind::kMagnetic) {
    reading += errors_.deviation.at(heading_rad) + errors_.variation_error_rad;
  } else if (!errors_.speed_corrected) {
    reading += steaming_error_rad(speed_north_mps, latitude_rad);
  }
  return frames::wrap_two_pi(reading);
}

}  // namespace ensonify::sensors
