#include "components/terrain/source_of.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "components/config/config_error.h"
#include "components/terrain/layers_source.h"
#include "components/terrain/raster_source.h"
#include "components/terrain/tile_set_source.h"

namespace ensonify::source {
namespace {

std::unique_ptr<TerrainSource> raster(const TerrainOptions& options) {
  const RasterSeabed& seabed = options.seabed.raster;
  RasterOptions raster;
  raster.path = seabed.path;
  raster.band = options.raster_band;
  raster.crs = options.raster_crs;
  raster.values_are_depths = seabed.values == RasterSeabed::Values::kDepth;
  raster.nodata = options.raster_nodata;
  raster.fill_holes = seabed.holes == RasterSeabed::Holes::kFill;
  std::optional<frames::Geodetic> origin;
  if (!options.site.origin_from_raster) origin = options.site.origin;
  return std::make_unique<RasterSource>(raster, origin);
}

std::unique_ptr<TerrainSource> tile_set(const TerrainOptions& options) {
  auto source = std::make_unique<TileSetSource>(options.seabed.tiles_folder);
  if (options.site.origin_from_raster) return source;
  if (const std::string fault = fault_of_origin(source->origin(), options.site.origin); !fault.empty()) {
    throw ConfigError({ConfigProblem{{options.seabed.tiles_folder, 0, 0},
                                     "origin",
                                     fault + "; write site: { origin: raster } to take that of the tiles"}});
  }
  return source;
}

}  // namespace

std::unique_ptr<TerrainSource> source_of(const TerrainOptions& options) {
  switch (options.seabed.kind) {
    case Seabed::Kind::kLayers: return std::make_unique<LayersSource>(options.seabed, options.site.origin);
    case Seabed::Kind::kRaster: return raster(options);
    case Seabed::Kind::kTiles: return tile_set(options);
  }
  return nullptr;
}

double post_spacing_m(const TerrainOptions& options, const TerrainSource& terrain) {
  if (options.seabed.kind == Seabed::Kind::kTiles) return terrain.native_spacing_m();
  return std::min(options.seabed.post_spacing_m, terrain.native_spacing_m());
}

double lsb_m(const TerrainOptions& options, const TerrainSource& terrain) {
  return terrain.lsb_m().value_or(options.seabed.lsb_m);
}

}  // namespace ensonify::source
