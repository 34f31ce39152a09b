#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "kernels/acoustics/trace/irregular.h"
#include "kernels/acoustics/trace/mesh.h"
#include "kernels/acoustics/trace/scene.h"
#include "kernels/mesh/lod/cover.h"

/// Parts of a scene. Private to this folder: it includes Embree.
namespace ensonify::trace {

struct Entry {
  std::uint32_t number;  // as Object has it
  terrain::Tile tile;
  lod::Hierarchy hierarchy;
  Heights heights;  // of the posts
  std::vector<Object> objects;
  lod::Cover cover;
};

/// Whether all of a tile is one object.
bool is_small(const terrain::Tile& tile);
/// Yet without their tile, which the scene's entry is to hold.
std::vector<Object> objects_of(const terrain::Tile& tile);

struct PartKey {
  terrain::TileKey tile;
  lod::Leaf leaf;
  lod::Rim rim;
  auto operator<=>(const PartKey&) const = default;
};

struct CachedPart {
  PartKey key;
  std::unique_ptr<BlockPart> part;
  std::uint64_t used = 0;     // last, by number of adaptation
  std::size_t triangles = 0;  // as was known then
};

struct Scene::Impl {
  Device device;
  frames::Vec2 origin_enu_m;
  LevelOfDetail detail;
  std::map<terrain::TileKey, Entry> tiles;
  std::map<std::int64_t, Irregular> irregular;
  std::uint32_t inserted = 0;                   // tiles and irregular meshes, ever
  std::vector<Object> objects;                  // of all tiles
  std::vector<double> facet_mean_square_slope;  // by class

  std::vector<lod::View> views;  // of the mesh ...
  bool stale = true;             // ... unless tiles have come or gone since
  std::uint64_t adaptations = 0;
  std::vector<CachedPart> parts;  // by key
  Mesh mesh;

  void gather_objects();
  void adapt(std::span<const lod::View> wanted);
  void show();
  /// Something comes or goes: there is no mesh until the next adaptation.
  void change();
  void change(const terrain::TileKey& key);
  /// All at full detail, unless detail depends on the view.
  void show_all();
  lod::Neighbours neighbours_of(const terrain::TileKey& key) const;
  /// Leaves of the covers, in order.
  std::vector<PartKey> wanted() const;
  /// Marks these parts as used and adds those that are missing, not yet built.
  void use(const std::vector<PartKey>& keys);
  /// Gives up parts that no mesh needs soon.
  void forget();
  /// By one of the views.
  bool is_in_view(const lod::Leaf& leaf) const;
};

}  // namespace ensonify::trace
