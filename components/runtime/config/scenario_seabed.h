#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "kernels/seabed/law.h"
#include "kernels/terrain/synthetic_seabed.h"

namespace ensonify {

struct RasterSeabed {
  enum class Values { kElevation, kDepth };  // up or down positive; never guessed
  enum class Holes { kRefuse, kKeep, kFill };
  std::string path;  // as found on disk
  Values values = Values::kElevation;
  Holes holes = Holes::kRefuse;
};

struct Seabed {
  enum class Kind { kSynthetic, kRaster, kTiles };
  Kind kind = Kind::kSynthetic;
  double post_spacing_m = 0.5;
  /// What the classes of posts are made of. Class 0 is always there (medium sand unless it is given); a class that is
  /// not listed is as class 0.
  std::map<std::uint8_t, seabed::Scatterer> sediments = {{0, *seabed::sediment_of("medium sand")}};
  /// Synthetic: a seabed generated from these values alone. Its seed is the scenario's.
  terrain::SyntheticSeabedParameters synthetic;
  std::array<double, 2> synthetic_size_m{600.0, 600.0};  // extent east and north, centred on the origin
  RasterSeabed raster;
  std::string tiles_folder;  // a tile set (docs/tiles.md), as found on disk
};

}  // namespace ensonify
