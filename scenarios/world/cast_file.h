#pragma once

#include <string>
#include <vector>

#include "scenarios/world/water.h"

namespace ensonify {

/// Names of a cast's columns in the first line of the file: the words there, or numbers from 1 for files
/// without such a line. A column that is left at its default may be missing.
struct CastColumns {
  std::string depth_m = "depth_m";
  std::string sound_speed_mps = "sound_speed_mps";
  std::string temperature_degc = "temperature_degc";
  std::string salinity_psu = "salinity_psu";
};

/// Limits of what a sample may hold, in a file and in a scenario alike.
namespace sample_limits {
inline constexpr double kDeepest_m = 12000.0, kSlowest_mps = 1300.0, kFastest_mps = 1700.0, kColdest_degc = -2.0,
                        kWarmest_degc = 40.0, kSaltiest_psu = 45.0;
}

/// Reads a cast: text with commas, semicolons or tabs between the columns; lines that start with # or % are skipped.
/// Throws ConfigError with places in that file: no such column, a value that is no number or outside the limits, depths
/// that do not rise from line to line (several casts in one file, a probe hauled up again).
std::vector<WaterSample> read_cast(const std::string& path, const CastColumns& columns);

}  // namespace ensonify
