#include "tools/grid/crs.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <cmath>

#include "components/errors/exit_error.h"

namespace ensonify::grid_tool {
namespace {

void destroy(OGRCoordinateTransformation* way) { OCTDestroyCoordinateTransformation(way); }

std::string wkt_of(const OGRSpatialReference& reference) {
  char* text = nullptr;
  reference.exportToWkt(&text);
  const std::string wkt = text == nullptr ? "" : text;
  CPLFree(text);
  return wkt;
}

OGRSpatialReference reference_of(const std::string& wkt) {
  OGRSpatialReference reference;
  reference.importFromWkt(wkt.c_str());
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return reference;
}

/// GDAL's own messages are not the user's.
struct Quiet {
  Quiet() { CPLPushErrorHandler(CPLQuietErrorHandler); }
  ~Quiet() { CPLPopErrorHandler(); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;
};

/// The UTM zone of a position, those of south-west Norway and Svalbard [DMA1989] included.
int utm_zone(const frames::Geodetic& at) {
  if (at.latitude_deg >= 56.0 && at.latitude_deg < 64.0 && at.longitude_deg >= 3.0 && at.longitude_deg < 12.0)
    return 32;
  if (at.latitude_deg >= 72.0 && at.latitude_deg < 84.0 && at.longitude_deg >= 0.0 && at.longitude_deg < 42.0)
    return 31 + 2 * static_cast<int>((at.longitude_deg + 3.0) / 12.0);
  return static_cast<int>(std::fmod(at.longitude_deg + 180.0, 360.0) / 6.0) + 1;
}

}  // namespace

std::string map_about(const frames::Geodetic& origin) {
  OGRSpatialReference reference;
  reference.SetProjCS(
      fmt::format("Ensonify world at {:.6f} {:.6f}", origin.latitude_deg, origin.longitude_deg).c_str());
  reference.SetWellKnownGeogCS("WGS84");
  reference.SetTM(origin.latitude_deg, origin.longitude_deg, 1.0, 0.0, 0.0);
  reference.SetLinearUnits("metre", 1.0);
  return wkt_of(reference);
}

std::string map_named(const std::string& name, const frames::Geodetic& about) {
  const Quiet quiet;
  OGRSpatialReference reference;
  const std::string given =
      name == "utm" ? fmt::format("EPSG:{}", (about.latitude_deg >= 0.0 ? 32600 : 32700) + utm_zone(about)) : name;
  if (reference.SetFromUserInput(given.c_str()) != OGRERR_NONE || !reference.IsProjected() ||
      std::abs(reference.GetLinearUnits() - 1.0) > 1e-9)
    throw UserError(
        fmt::format("--crs {}: is no map in metres; allowed: utm, or a projected system such as EPSG:32619", name));
  return wkt_of(reference);
}

Transformation::Transformation(const std::string& from_wkt, const std::string& to_wkt) : way_(nullptr, destroy) {
  if (from_wkt == to_wkt) return;
  const OGRSpatialReference from = reference_of(from_wkt), to = reference_of(to_wkt);
  way_.reset(OGRCreateCoordinateTransformation(&from, &to));
  if (!way_) throw UserError("there is no way from one of the files' maps to the grid's");
}

Transformation::~Transformation() = default;

bool Transformation::transform(double& x_m, double& y_m) const {
  if (!way_) return true;
  const Quiet quiet;
  return way_->Transform(1, &x_m, &y_m) != 0;
}

}  // namespace ensonify::grid_tool
