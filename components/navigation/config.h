#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "components/navigation/heights.h"
#include "components/navigation/instrument_config.h"
#include "components/navigation/true_water.h"
#include "scenarios/world/world.h"

namespace ensonify {

class ConfigReader;

/// The simplest instruments, in place of those that are not listed: truth and white noise. Standard deviations, each
/// sample and axis on its own.
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

/// The sound speed probe, meant to sit beside the transducers' faces.
struct SoundSpeedProbe {
  std::array<double, 3> position_body_m{};  // forward, starboard, down from the body's origin
  int rate_hz = 1;
  double bias_mps = 0.0;    // measured minus true, the same all through a run
  double sigma_mps = 0.02;  // white noise
  double latency_s = 0.0;   // from the measurement to its report

  bool operator==(const SoundSpeedProbe&) const = default;
};

struct NavigationConfig {
  int attitude_rate_hz = 100;  // attitude and estimate
  int position_rate_hz = 5;
  double position_gain = 0.2;       // how much of a fix's difference from the estimate is taken over, 0..1
  double motion_latency_s = 0.0;    // age of attitude and velocity at their stamp: a sensor that does not state its own
  double position_latency_s = 0.0;  // the same of the estimate's east and north
  NavigationErrors sigma;
  SoundSpeedProbe probe;
  Instruments instruments;

  // From the scenario.
  std::uint64_t seed = 1;
  std::string process;
  Heights heights;
  std::optional<frames::Geodetic> origin;  // not given: the chart gives it
  TrueWater water;

  static NavigationConfig read(ConfigReader& from, const World& world, const std::string& process);
  /// The parameters that have a default in default.yaml.
  bool operator==(const NavigationConfig& other) const {
    return attitude_rate_hz == other.attitude_rate_hz && position_rate_hz == other.position_rate_hz &&
           position_gain == other.position_gain && motion_latency_s == other.motion_latency_s &&
           position_latency_s == other.position_latency_s && sigma == other.sigma && probe == other.probe;
  }
};

}  // namespace ensonify
