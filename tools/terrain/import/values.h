#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "components/terrain/raster_file.h"
#include "tools/terrain/import/options.h"

namespace ensonify::terrain_import {

/// Conversion of a file's values to elevations in metres, up.
struct ValueFacts {
  bool down = false;     // they were depths
  std::string down_why;  // who said so
  double unit_m = 1.0;   // metres in one of them
  std::string unit;
  std::int64_t marked = 0;  // cells that the user's marks made holes
  double lowest_m = 0.0, highest_m = 0.0;
};

/// Turns the values of a file into elevations, in place, before any datum: marks of missing values, sign, unit.
///
/// Sign "auto": values of which more than half are negative are elevations, for as depths they would be dry; others are
/// what the file says (the axis of its vertical reference system, an attribute `positive`, a name with "depth",
/// "elevation", "altitude" or "height" in it); a file that says nothing, or both, is refused.
/// Unit "auto": what the file says, else metres. Refused with place, cause and what is allowed: marks of missing values
/// that are not declared, heights that no planet of ours has, whole numbers that ran over their type.
ValueFacts elevations_of(const source::RasterFile& file, const FileOptions& options, std::span<float> values);

/// Holes where a value is one of the marks; how many there were.
std::int64_t drop_marked(std::span<float> values, const std::vector<double>& marks);

/// Refuses marks of missing values that are at an end of the values' range.
void refuse_usual_marks(const source::RasterFile& file, double lowest, double highest);

/// Metres in a unit; throws UserError, beginning with `who`, for an unknown one.
double metres_in(const std::string& unit, const std::string& who);

/// The whole text as a number; nothing if it is none.
std::optional<double> number_in(const std::string& text);

/// Numbers with commas between; throws UserError, beginning with `option`, unless there are from `least` to `most`.
std::vector<double> numbers_in(const std::string& text, const std::string& option, std::size_t least, std::size_t most);

/// A file as it stands on the command line: "PATH" or "PATH?key=value&key=value", with what is said of all files for
/// the rest. Keys: crs, positive, units, nodata (with commas), datum-shift, vertical, band. Throws UserError.
FileOptions file_of(const std::string& words, FileOptions all);

}  // namespace ensonify::terrain_import
