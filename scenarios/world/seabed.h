#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/config/config_error.h"
#include "kernels/mesh/progressive/bars.h"
#include "kernels/mesh/progressive/sheet_pile_wall.h"
#include "kernels/mesh/progressive/strewn.h"
#include "kernels/seabed/law.h"
#include "scenarios/world/layers.h"

namespace ensonify {

struct RasterSeabed {
  enum class Values { kElevation, kDepth };  // up or down positive; never guessed
  enum class Holes { kRefuse, kKeep, kFill };
  std::string path;  // as found on disk
  Values values = Values::kElevation;
  Holes holes = Holes::kRefuse;
};

/// A seabed generated from layers, from the bottom up.
struct LayeredSeabed {
  std::uint64_t seed = 0;                                                             // the scenario's
  frames::Vec2 size_m{600.0, 600.0};                                                  // east, north
  frames::Vec2 centre_enu_m{0.0, 0.0};                                                // of that rectangle
  std::vector<layers::Layer> layers = {{.name = "ground", .form = relief::Plane{}}};  // level, 20 m deep
};

/// Copies that stand on the ground, each with its origin at the ground's height.
struct StrewnCopies {
  int count = 1;
  progressive::Strewn where;
  std::vector<std::uint8_t> on;  // classes of the ground on which they stand; none: on any
  ConfigPlace place;             // for messages
};

/// A surface of triangles that stands in the seabed: of a file, of bars, or a quay wall.
struct SeabedMesh {
  std::string name;
  std::string file;                                    // as found on disk; "": what follows
  double unit_m = 1.0;                                 // metres in the file's unit
  frames::Vec3 position_enu_m = frames::Vec3::Zero();  // of the file's origin, or the bars'
  double heading_rad = 0.0;                            // of its y axis, clockwise from north
  std::optional<progressive::SheetPileWall> wall;
  std::uint8_t sediment = 0;  // of all of it, one of Seabed::sediments
  std::vector<progressive::Bar> bars;
  std::optional<StrewnCopies> strewn;  // of the file or the bars; without it there is one, at the position
};

struct Seabed {
  enum class Kind { kLayers, kRaster, kTiles };
  Kind kind = Kind::kLayers;
  double post_spacing_m = 0.5;
  double lsb_m = 2e-4;  // heights are whole multiples of this; a tile set has its own
  /// Sediments of the classes of posts. Class 0 is always there (medium sand unless it is given); a class that is
  /// not listed is as class 0.
  std::map<std::uint8_t, seabed::Scatterer> sediments = {{0, *seabed::sediment_of("medium sand")}};
  LayeredSeabed layered;
  RasterSeabed raster;
  std::vector<SeabedMesh> meshes;  // in the order of the file
  std::string tiles_folder;        // a tile set (docs/manual/tiles.md), as found on disk
};

}  // namespace ensonify
