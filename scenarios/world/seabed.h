#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "components/config/config_error.h"
#include "components/config/parameters.h"
#include "kernels/mesh/progressive/objects.h"
#include "kernels/seabed/law.h"
#include "scenarios/world/layers.h"
#include "scenarios/world/mission.h"

namespace ensonify {

struct RasterSeabed {
  enum class Values { kElevation, kDepth };  // up or down positive; never guessed
  enum class Holes { kRefuse, kKeep, kFill };
  std::string path;  // as found on disk
  Values values = Values::kElevation;
  Holes holes = Holes::kRefuse;

  static void parameters(auto& self, auto&& visit) {
    visit("path", "", must(ensonify::path()), "a file that GDAL reads", self.path);
    visit("values", "", must(one_of({{"elevation", Values::kElevation}, {"depth", Values::kDepth}})),
          "positive up or down", self.values);
    visit("holes", "", one_of({{"refuse", Holes::kRefuse}, {"keep", Holes::kKeep}, {"fill", Holes::kFill}}),
          "posts without a value", self.holes);
  }
};

/// A seabed generated from layers, from the bottom up.
struct LayeredSeabed {
  std::uint64_t seed = 0;  // the scenario's
  std::string file;        // the scenario's, for messages
  frames::Vec2 size_m{600.0, 600.0};
  frames::Vec2 centre_enu_m{0.0, 0.0};
  std::vector<layers::Layer> layers = {{.name = "ground", .form = relief::Plane{}}};  // level, 20 m deep

  static void parameters(auto& self, auto&& visit) {
    visit("size_m", "m", in(0.1, kFarAway_m), "size of a generated seabed: east, north", self.size_m);
    visit("centre_m", "m", in(-kFarAway_m, kFarAway_m), "centre of a generated seabed: east, north", self.centre_enu_m);
  }
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
  enum class Up { kY, kZ };
  Up up = Up::kZ;                 // axis of the file that points up; with y up its -z is the y of the line above
  double tilt_rad = 0.0;          // of its upright from the vertical
  double tilt_heading_rad = 0.0;  // towards which it leans, clockwise from north
  std::optional<progressive::SheetPileWall> wall;
  std::uint8_t sediment = 0;  // of all of it, one of Seabed::sediments
  std::vector<progressive::Bar> bars;
  std::optional<StrewnCopies> strewn;  // of the file or the bars; without it there is one, at the position
};

struct Seabed {
  enum class Kind { kLayers, kRaster, kTiles };
  Kind kind = Kind::kLayers;
  double post_spacing_m = 0.5;
  double lsb_m = 2e-4;
  /// Sediments of the classes of posts. Class 0 is always there (medium sand unless it is given); a class that is
  /// not listed is as class 0.
  std::map<std::uint8_t, seabed::Scatterer> sediments = {{0, *seabed::sediment_of("medium sand")}};
  LayeredSeabed layered;
  RasterSeabed raster;
  std::vector<SeabedMesh> meshes;  // in the order of the file
  std::string tiles_folder;        // a tile set (docs/manual/tiles.md), as found on disk

  /// What of it has one value; the rest is in SeabedKeys.
  static void parameters(auto& self, auto&& visit) {
    visit("post_spacing_m", "m", in(0.005, 100), "distance between posts", self.post_spacing_m);
    visit("lsb_m", "m", in(1e-6, 1), "step of heights, which are whole multiples of it; a tile set has its own",
          self.lsb_m);
  }
};

/// Sediment as facets of that rms slope (0 to 35 degrees) change it.
seabed::MeshedSediment on_facets(const std::variant<seabed::SedimentParameters, seabed::CappedSediment>& whole,
                                 double facet_slope_deg);

/// A scenario's sediments as they scatter on a mesh whose facets have these mean square slopes, by class: those by
/// TR 9407 become those of facets, where the scenario does not say itself how steep these are. 0, or a class beyond the
/// end: as it was.
std::map<std::uint8_t, seabed::Scatterer> on_mesh(std::map<std::uint8_t, seabed::Scatterer> sediments,
                                                  std::span<const double> mean_square_slope);

/// The same slope of a meshed sediment.
double facet_slope_deg(const seabed::MeshedSediment& meshed);

}  // namespace ensonify
