#pragma once

#include <string>

#include "tools/plan/plan_text.h"

namespace ensonify::plan {

/// Lines that survey software wrote, by the file's ending:
///
/// - .lnw: planned lines of Hypack: LNS number of lines; for each LIN number of places, PTS x y, LNN name, EOL. Other
///   records of three capitals behind a line's places, as templates of cross-sections, are passed over. Projected:
///   needs `crs`, or `metres` where x and y are the world's.
/// - .csv: a header with `line` (places of one line stand together) and either `latitude_deg` and `longitude_deg`, or
///   `east_m` and `north_m` (world metres, or with `crs` in that system); `name` may be there, other columns are left
///   out. Cells may be quoted.
/// - .geojson, .json: every line string, in the order of the file, by the file's own reference system (WGS 84).
/// - .kml, .gpx: every line string of a placemark, every route, WGS 84.
///
/// Points, areas and tracks are left out. `crs` is what GDAL understands, e.g. EPSG:32629. Places come out geodetic,
/// WGS 84, unless they are the world's own metres. Throws UserError with file, line and what is allowed: no lines,
/// lines of less than two places or of no length, places that are no numbers or outside the globe.
LineSet read_lines(const std::string& path, const std::string& crs);

// One reader for each kind of file that read_lines() takes. Each throws UserError with the place of what it cannot
// read; what no vehicle can run they leave to read_lines().

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
