#pragma once

#include <string>

#include "tools/plan/plan_text.h"

namespace ensonify::plan {

// One reader for each kind of file that read_lines() takes (line_files.h says what each reads). Each throws UserError
// with the place of what it cannot read; what no vehicle can run they leave to read_lines().

LineSet read_lnw(const std::string& path);
LineSet read_csv(const std::string& path, bool projected);
LineSet read_geojson(const std::string& path);
LineSet read_kml(const std::string& path);
LineSet read_gpx(const std::string& path);

/// Turns projected places into geodetic ones. `path` is named in errors.
LineSet geodetic_from(const LineSet& projected, const std::string& crs, const std::string& path);

/// All of `text` as a finite number; `place` is named in the error.
double number_of(const std::string& text, const std::string& place);

}  // namespace ensonify::plan
