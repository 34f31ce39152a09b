#include <cmath>

#include "components/terrain/raster_source.h"
#include "tools/terrain/import/mosaic.h"

namespace ensonify::terrain_import {
namespace {

/// Height of the mosaic at a place from whole steps, as the tiles hold it; NaN where there is none.
class Stored {
 public:
  Stored(const terrain::Tile& tile, double lsb_m) : tile_(tile), lsb_m_(lsb_m) {
    patch_.spacing_m = tile.spacing_m;
    patch_.columns = patch_.rows = 2;
    patch_.height_m.resize(4);
    patch_.sediment.resize(4);
  }

  double at(const frames::Vec2& place) {
    const frames::Vec2 post = ((place - tile_.origin_enu_m) / tile_.spacing_m).array().floor();
    if (!(post.x() >= 0.0 && post.y() >= 0.0 && post.x() + 1.0 < tile_.columns && post.y() + 1.0 < tile_.rows))
      return std::nan("");
    const auto column = static_cast<std::int32_t>(post.x()), row = static_cast<std::int32_t>(post.y());
    patch_.origin_enu_m = tile_.origin_enu_m + post * tile_.spacing_m;
    for (std::int32_t k = 0; k < 4; ++k) {
      const float height_m = tile_.height_m[tile_.post(column + k % 2, row + k / 2)];
      patch_.height_m[patch_.post(k % 2, k / 2)] = terrain::on_lattice(height_m, lsb_m_);
    }
    return terrain::height_m(patch_, place).value_or(std::nan(""));
  }

 private:
  const terrain::Tile& tile_;
  double lsb_m_;
  terrain::Tile patch_;
};

}  // namespace

std::vector<CellFacts> cell_facts(const std::vector<SurveyFile>& files, const Mosaic& mosaic,
                                  const ImportOptions& options, double lsb_m) {
  std::vector<CellFacts> facts(files.size());
  std::vector<std::unique_ptr<source::RasterSource>> rasters;
  Stored stored(mosaic.tile(), lsb_m);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const SurveyFile& file = files[i];
    rasters.push_back(std::make_unique<source::RasterSource>(file.raster, mosaic.origin()));
    std::optional<source::RasterSource> datum;
    if (!file.options.vertical.empty()) {
      FileOptions separations;
      separations.path = file.options.vertical;
      datum.emplace(std::make_shared<source::RasterFile>(
                        raster_options(separations, options.origin.value_or(mosaic.origin()), {})),
                    mosaic.origin());
    }
    double square = 0.0;
    for (const auto& [column, row, height_m] : file.kept_cells) {
      const frames::Vec2 place = rasters[i]->place_of(column, row);
      bool decided = false;  // by a better file
      for (std::size_t j = 0; j < i && !decided; ++j) decided = std::isfinite(rasters[j]->height_m(place));
      if (decided) continue;
      const double off_m = stored.at(place) - (static_cast<double>(height_m) + file.options.datum_shift_m +
                                               (datum ? datum->height_m(place) : 0.0));
      if (!std::isfinite(off_m)) continue;
      ++facts[i].cells;
      square += off_m * off_m;
      facts[i].largest_m = std::max(facts[i].largest_m, std::abs(off_m));
    }
    if (facts[i].cells > 0) facts[i].rms_m = std::sqrt(square / static_cast<double>(facts[i].cells));
  }
  return facts;
}

}  // namespace ensonify::terrain_import
