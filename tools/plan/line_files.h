#pragma once

#include <string>

#include "tools/plan/plan_text.h"

namespace ensonify::plan {

/// Lines that survey software wrote, by the file's ending:
///
/// - .lnw: planned lines of Hypack: LNS number of lines; for each LIN number of places, PTS x y, LNN name, EOL.
/// Projected:
///   needs `crs`, or `metres` where x and y are the world's.
/// - .csv: a header with `line` (places of one line stand together) and either `latitude_deg` and `longitude_deg`, or
///   `east_m` and `north_m` (world metres, or with `crs` in that system); `name` may be there, other columns are left
///   out.
/// - .geojson, .json, .kml, .gpx: every line string and route, in the order of the file, by their own reference system
///   (WGS 84). Points, areas and tracks are left out.
///
/// `crs` is what GDAL understands, e.g. EPSG:32629. Places come out geodetic, WGS 84, unless they are the world's own
/// metres. Throws UserError with file, line and what is allowed: no lines, lines of less than two places or of no
/// length, places that are no numbers or outside the globe.
LineSet read_lines(const std::string& path, const std::string& crs);

/// Turns projected places into geodetic ones.
LineSet geodetic_from(const LineSet& projected, const std::string& crs, const std::string& path);

/// The third kind above.
LineSet read_vector_file(const std::string& path);

}  // namespace ensonify::plan
