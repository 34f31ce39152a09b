#pragma once

#include "kernels/vehicle/vertical/reduction.h"
#include "kernels/vehicle/vertical/tide.h"

namespace ensonify {

class ConfigReader;

/// Relation of heights: the water level above chart datum, and chart datum between geoid and ellipsoid.
struct Vertical {
  vertical::Tide tide;
  vertical::Datums datums;
};

/// `vertical:` of a scenario.
Vertical read_vertical(ConfigReader from, double start_unix_s);

/// The tide of a gauge: lines "2025-06-01T12:00:00Z,1.35", time in UTC and metres above chart datum, times rising;
/// lines that start with # and a first line of column names are skipped. Throws ConfigError with places in that file.
vertical::GaugeReadings read_gauge(const std::string& path, double start_unix_s);

/// A grid of separations, an Esri ASCII file (ncols, nrows, xllcorner, yllcorner, cellsize, NODATA_value if there is
/// one, then rows from north to south, cell centres) in the world's own metres; cells without a value are refused.
/// Throws ConfigError with the place of what is wrong.
vertical::Separation read_separation(const std::string& path);

}  // namespace ensonify
