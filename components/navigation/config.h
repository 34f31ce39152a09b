#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "components/runtime/config/scenario.h"

namespace ensonify {

class ConfigReader;

/// Standard deviations of white noise, each sample and axis on its own.
struct NavigationErrors {
  static constexpr double kDegree_rad = 3.14159265358979323846 / 180.0;

  double roll_rad = 0.02 * kDegree_rad;
  double pitch_rad = 0.02 * kDegree_rad;
  double heading_rad = 0.05 * kDegree_rad;
  double heave_m = 0.02;
  double horizontal_m = 0.05;
  double vertical_m = 0.05;
  double velocity_mps = 0.02;

  bool operator==(const NavigationErrors&) const = default;
};

struct NavigationConfig {
  int attitude_rate_hz = 100;  // attitude and estimate
  int position_rate_hz = 5;
  double position_gain = 0.2;  // how much of a fix's difference from the estimate is taken over, 0..1
  NavigationErrors sigma;

  // From the scenario.
  std::uint64_t seed = 1;
  std::string process;
  double mean_height_m = 0.0;              // ENU z from which heave counts
  std::optional<frames::Geodetic> origin;  // not given: the chart tells it

  static NavigationConfig read(ConfigReader& from, const Scenario& scenario, const std::string& process);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const NavigationConfig& other) const {
    return attitude_rate_hz == other.attitude_rate_hz && position_rate_hz == other.position_rate_hz &&
           position_gain == other.position_gain && sigma == other.sigma;
  }
};

}  // namespace ensonify
