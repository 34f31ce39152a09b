#pragma once

#include <string>
#include <vector>

#include "components/config/parameters.h"
#include "scenarios/world/water.h"

namespace ensonify {

/// Names of a cast's columns in the first line of the file: the words there, or numbers from 1 for files
/// without such a line. A column that is left at its default may be missing.
struct CastColumns {
  std::string depth_m = "depth_m";
  std::string sound_speed_mps = "sound_speed_mps";
  std::string temperature_degc = "temperature_degc";
  std::string salinity_psu = "salinity_psu";

  static void parameters(auto& self, auto&& visit) {
    visit("depth_m", "", any(), "column of depths, positive down", self.depth_m);
    visit("sound_speed_mps", "", any(), "column of sound speeds", self.sound_speed_mps);
    visit("temperature_degc", "", any(), "column of temperatures", self.temperature_degc);
    visit("salinity_psu", "", any(), "column of salinities", self.salinity_psu);
  }
  bool operator==(const CastColumns&) const = default;
};

/// Reads a cast: text with commas, semicolons or tabs between the columns, or blanks where the first line has none of
/// these. Lines that are empty or start with # or % are skipped, and no others. Two columns of numbers without a line
/// of names are depth and sound speed. Throws ConfigError with places in that file: no such column, a value that is no
/// number or outside the limits, depths that do not rise from line to line (several casts in one file, a probe hauled
/// up again).
std::vector<WaterSample> read_cast(const std::string& path, const CastColumns& columns = {});

}  // namespace ensonify
