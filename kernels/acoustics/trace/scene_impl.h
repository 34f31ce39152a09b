#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "kernels/acoustics/trace/parts.h"
#include "kernels/acoustics/trace/scene.h"
#include "kernels/mesh/lod/cover.h"
#include "kernels/mesh/progressive/cut.h"

/// Parts of a scene, those of irregular meshes too. Private to this folder: it includes Embree.
namespace ensonify::trace {

/// Triangles of an irregular mesh that are neighbours.
class TrianglePart final : public Part {
 public:
  /// Base of all parts of a mesh.
  struct Common {
    std::uint32_t number = 0;  // as Hit has them
    float facet_m = 0.0F;
    std::uint32_t contributor = 0;
  };
  /// Of all the mesh's vertices in Embree's frame, and room for one more, which Embree may read.
  using Places = std::shared_ptr<const std::vector<Eigen::Vector3f>>;
  TrianglePart(const Device& device, std::vector<progressive::Triangle> triangles, Places places_m,
               const Common& common);

  const std::vector<progressive::Triangle>& shown() const { return triangles_; }

 private:
  Content content() const override;

  std::vector<progressive::Triangle> triangles_;
  Places places_m_;
};

/// An irregular mesh as a scene has it. Its triangles are in clusters of neighbours, each a part, so that what stays
/// from ping to ping is not built again, and a part is so small that Embree builds it in the same way on however many
/// threads.
class Irregular {
 public:
  Irregular(progressive::Hierarchy hierarchy, std::uint32_t number, std::uint32_t contributor);

  /// As finely as these views ask for: of level 0 all of it, of level n to a tenth of 2^n mean edges.
  void choose(std::span<const lod::View> views);
  void choose_all();

  /// The parts of what has been chosen; those that are new are built.
  std::vector<std::shared_ptr<const Part>> show(const Device& device, const terrain::Vec2& origin_enu_m);
  /// Builds all anew when they are next shown: the origin has moved.
  void forget();

  std::size_t triangles() const;
  const Eigen::AlignedBox3d& box_enu_m() const { return box_enu_m_; }

 private:
  struct Cluster {
    std::vector<progressive::Triangle> wanted;
    std::shared_ptr<TrianglePart> part;
  };
  void want(std::span<const progressive::Triangle> triangles, std::span<const std::uint32_t> sources);

  progressive::Hierarchy hierarchy_;
  TrianglePart::Common common_;  // facet_m: of the mean triangle
  Eigen::AlignedBox3d box_enu_m_;
  double edge_m_ = 0.0;                    // mean
  std::vector<std::uint32_t> cluster_of_;  // by source triangle
  TrianglePart::Places places_m_;          // null while Embree's frame is not known
  std::vector<Cluster> clusters_;
  progressive::Cut cut_;
};

/// A body and its triangles, which are always all there.
struct BodyEntry {
  ShownBody shown;
  Irregular triangles;
};

struct Entry {
  std::uint32_t number;  // as Object has it
  std::shared_ptr<const Ground> ground;
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
  std::shared_ptr<BlockPart> part;
  std::uint64_t used = 0;     // last, by number of adaptation
  std::size_t triangles = 0;  // as was known then
};

/// Where there is geometry.
struct Extent {
  frames::Vec2 south_west_enu_m, north_east_enu_m;
  Heights heights;
};

/// Over what lies within a horizontal distance of a place; empty when there is nothing.
std::optional<Heights> heights_near(std::span<const Extent> extents, const frames::Vec2& place_enu_m, double radius_m);

struct Mesh::Content {
  frames::Vec2 origin_enu_m;
  PartTree tree;
  std::vector<Extent> extents;  // of tiles, irregular meshes and bodies
  std::shared_ptr<const std::vector<Object>> objects;
  std::vector<std::shared_ptr<const Ground>> grounds;  // of the objects
  std::vector<ShownBody> bodies;
  Contributors contributors;
};

struct Scene::Impl {
  Device device;
  frames::Vec2 origin_enu_m;
  LevelOfDetail detail;
  std::map<terrain::TileKey, Entry> tiles;
  std::map<std::int64_t, Irregular> irregular;
  std::map<std::uint32_t, BodyEntry> bodies;
  std::uint32_t inserted = 0;  // tiles, irregular meshes and bodies, ever
  std::shared_ptr<const std::vector<Object>> objects = std::make_shared<std::vector<Object>>();  // of all tiles
  std::shared_ptr<const std::vector<double>> facet_mean_square_slope;  // by class; null: none is known

  std::mutex adapting;           // one thread at a time, of what follows
  std::vector<lod::View> views;  // of the mesh ...
  bool stale = true;             // ... unless tiles have come or gone since
  std::uint64_t adaptations = 0;
  std::vector<CachedPart> parts;  // by key
  Mesh mesh;

  void gather_objects();
  void centre_near(const frames::Vec2& place_enu_m);
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
  std::vector<Extent> extents() const;
  /// By one of the views.
  bool is_in_view(const lod::Leaf& leaf) const;
};

}  // namespace ensonify::trace
