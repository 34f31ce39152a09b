#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "scenarios/world/layer_terms.h"
#include "scenarios/world/mesh_keys.h"
#include "scenarios/world/sediment_keys.h"

/// `seabed:` of a scenario as its file has it.
namespace ensonify {

struct GeneratedSeabed {
  static constexpr const char* kWord = "layers";
  LayeredSeabed values;  // what has one value
  std::vector<terms::Layer> layers;

  GeneratedSeabed() {
    layers.emplace_back().name = "ground";  // level, 20 m deep
    layers.back().is = terms::Is<terms::Plane>{};
  }
  static void parameters(auto& self, auto&& visit) {
    LayeredSeabed::parameters(self.values, visit);
    visit("layers", "layers of a generated seabed, from the bottom up", self.layers);
  }
  void check(const ConfigReader& from) const;
};
struct SeabedOfRaster {
  static constexpr const char* kWord = "raster";
  RasterSeabed raster;

  static void parameters(auto& self, auto&& visit) {
    visit("raster", "", must(any()), "an imported raster", self.raster);
  }
};
struct TilesKeys {
  std::string folder;

  static void parameters(auto& self, auto&& visit) {
    visit("folder", "", must(path()), "folder of the tile set", self.folder);
  }
};
struct SeabedOfTiles {
  static constexpr const char* kWord = "tiles";
  TilesKeys tiles;

  static void parameters(auto& self, auto&& visit) {
    visit("tiles", "", must(any()), "an imported tile set", self.tiles);
  }
};

struct SeabedKeys {
  std::variant<GeneratedSeabed, SeabedOfRaster, SeabedOfTiles> kind;
  Seabed values;  // what has one value
  std::map<std::uint8_t, SedimentKeys> sediments;
  std::vector<MeshKeys> meshes;

  SeabedKeys();
  static void parameters(auto& self, auto&& visit) {
    visit(form_by("kind", "generated from layers, or imported", "is not used by this kind of seabed", true), self.kind);
    Seabed::parameters(self.values, visit);
    visit("sediments", "", called("a class of the seabed", in(0, 255)),
          "sediments that the classes of posts are made of, by number", self.sediments);
    visit("meshes", "meshes that stand in the seabed", self.meshes);
  }
  void check(const ConfigReader& from) const;
  Seabed seabed() const;
};

}  // namespace ensonify
