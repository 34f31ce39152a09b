#pragma once

#include <cstdint>
#include <string>

namespace ensonify {

class ConfigReader;
struct World;

struct GyroConfig {
  int rate_hz = 10;
  double bias_rad = 0.5 * 3.14159265358979323846 / 180.0;
  double sigma_rad = 0.1 * 3.14159265358979323846 / 180.0;

  // From the scenario.
  std::uint64_t seed = 1;
  std::string process;

  static GyroConfig read(ConfigReader& from, const World& world, const std::string& process);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const GyroConfig& other) const {
    return rate_hz == other.rate_hz && bias_rad == other.bias_rad && sigma_rad == other.sigma_rad;
  }
};

}  // namespace ensonify
