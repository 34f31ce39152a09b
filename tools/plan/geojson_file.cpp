#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include <memory>

#include "components/errors/exit_error.h"
#include "tools/plan/line_files.h"

namespace ensonify::plan {
namespace {

OGRSpatialReference wgs84() {
  OGRSpatialReference reference;
  reference.importFromEPSG(4326);
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);  // longitude first
  return reference;
}

using Transformation = std::unique_ptr<OGRCoordinateTransformation>;

std::array<double, 2> geodetic(OGRCoordinateTransformation* to_wgs84, double x, double y, const std::string& place) {
  if (to_wgs84 != nullptr && to_wgs84->Transform(1, &x, &y) == 0) {
    throw UserError(fmt::format(
        "{}: ({}, {}) cannot be turned into latitude and longitude; is the reference system right?", place, x, y));
  }
  return {y, x};
}

void add(LineSet& set, const OGRGeometry* geometry, const std::string& name, OGRCoordinateTransformation* to_wgs84,
         const std::string& path) {
  if (geometry == nullptr) return;
  const OGRwkbGeometryType type = wkbFlatten(geometry->getGeometryType());
  if (type == wkbLineString) {
    LineSet::Line line{name, {}};
    for (const OGRPoint& point : *geometry->toLineString()) {
      line.places.push_back(geodetic(to_wgs84, point.getX(), point.getY(), path));
    }
    set.lines.push_back(line);
  } else if (type == wkbMultiLineString || type == wkbGeometryCollection) {
    for (const auto* part : *geometry->toGeometryCollection()) add(set, part, name, to_wgs84, path);
  }
}

}  // namespace

LineSet geodetic_from(const LineSet& projected, const std::string& crs, const std::string& path) {
  OGRSpatialReference from;
  CPLPushErrorHandler(CPLQuietErrorHandler);
  const bool known = from.SetFromUserInput(crs.c_str()) == OGRERR_NONE;
  CPLPopErrorHandler();
  if (!known) throw UserError("--crs " + crs + ": is no reference system; allowed is what GDAL knows, e.g. EPSG:32629");
  from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const OGRSpatialReference to = wgs84();
  const Transformation transformation(OGRCreateCoordinateTransformation(&from, &to));
  if (!transformation) throw UserError("--crs " + crs + ": has no way to WGS 84");
  LineSet set = projected;
  set.geodetic = true;
  for (auto& line : set.lines) {
    for (auto& place : line.places) place = geodetic(transformation.get(), place[0], place[1], path);
  }
  return set;
}

LineSet read_geojson(const std::string& path) {
  GDALAllRegister();
  CPLPushErrorHandler(CPLQuietErrorHandler);
  const std::unique_ptr<GDALDataset> file(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
  const std::string why = CPLGetLastErrorMsg();
  CPLPopErrorHandler();
  if (!file) throw UserError(path + ": cannot be read" + (why.empty() ? "" : ": " + why));
  LineSet set;
  set.geodetic = true;
  const OGRSpatialReference to = wgs84();
  for (OGRLayer* layer : file->GetLayers()) {
    Transformation transformation;
    if (const OGRSpatialReference* own = layer->GetSpatialRef()) {
      OGRSpatialReference from(*own);
      from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
      transformation.reset(OGRCreateCoordinateTransformation(&from, &to));
    }
    for (const auto& feature : *layer) {
      const int name = feature->GetDefnRef()->GetFieldIndex("name");  // as GDAL compares: Name and NAME too
      add(set, feature->GetGeometryRef(), name >= 0 ? feature->GetFieldAsString(name) : "", transformation.get(), path);
    }
  }
  return set;
}

}  // namespace ensonify::plan
