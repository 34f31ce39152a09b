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

}  // namespace ensonify::plan
