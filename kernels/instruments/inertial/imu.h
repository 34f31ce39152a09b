#pragma once

#include <array>
#include <cstdint>

#include "kernels/base/frames/attitude.h"
#include "kernels/base/random/stream.h"
#include "kernels/instruments/inertial/strapdown.h"

namespace ensonify::inertial {

/// Errors of three like sensors at right angles, each quantity for every axis on its own [IEEE952; Titterton2004,
/// ch. 8]. u is rad/s for gyros and m/s^2 for accelerometers. Zero switches an error off and moves no other draw.
struct TriadErrors {
  double scale_factor = 0.0;      // standard deviation, 1
  double misalignment_rad = 0.0;  // of each small angle between an input axis and the two other body axes
  double turn_on_bias = 0.0;      // standard deviation, u; the same from switching on to switching off
  double bias_sigma = 0.0;        // u, of a Gauss-Markov bias: what data sheets call in-run stability
  double bias_time_s = 3600.0;    // > 0, its correlation time
  double random_walk = 0.0;       // u sqrt(s): angle or velocity random walk, white noise of the reading
  double rate_random_walk = 0.0;  // u / sqrt(s)
  double quantum = 0.0;           // rad or m/s: smallest step of the integrated reading
};

/// Three sensors that report increments: the integral of the reading since the last sample.
class Triad {
 public:
  Triad(const TriadErrors& errors, const random::Stream& stream);

  /// Reading reported for a true mean (u) over the next dt (> 0).
  frames::Vec3 increment(const frames::Vec3& true_mean, double dt_s);

  /// Bias at this moment, all its parts, u: truth for judging a filter.
  frames::Vec3 bias() const;

 private:
  TriadErrors errors_;
  random::Stream stream_;
  Eigen::Matrix3d sensed_from_true_;
  frames::Vec3 turn_on_, walk_ = frames::Vec3::Zero();
  std::array<random::GaussMarkov, 3> wandering_;
  frames::Vec3 unreported_ = frames::Vec3::Zero();  // the part of the integral that is below one quantum
  std::uint64_t n_ = 0;                             // samples so far
};

struct ImuErrors {
  TriadErrors gyro;
  TriadErrors accelerometer;
};

/// An inertial measurement unit: two triads, a stream for each.
class Imu {
 public:
  Imu(const ImuErrors& errors, const random::Stream& gyro, const random::Stream& accelerometer)
      : gyro_(errors.gyro, gyro), accelerometer_(errors.accelerometer, accelerometer) {}

  /// Mean readings over the next dt, from what ideal sensors would read.
  Inertial measure(const Inertial& truth, double dt_s) {
    return {gyro_.increment(truth.rate_radps, dt_s) / dt_s, accelerometer_.increment(truth.force_mps2, dt_s) / dt_s};
  }

  const Triad& gyro() const { return gyro_; }
  const Triad& accelerometer() const { return accelerometer_; }

 private:
  Triad gyro_, accelerometer_;
};

}  // namespace ensonify::inertial
