#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kernels/acoustics/trace/body.h"
#include "kernels/acoustics/trace/contributors.h"
#include "kernels/acoustics/trace/ray.h"
#include "kernels/base/frames/pose.h"
#include "kernels/mesh/lod/cover.h"
#include "kernels/mesh/progressive/hierarchy.h"
#include "kernels/mesh/tile.h"
#include "kernels/water/refraction/path_table.h"

namespace ensonify::trace {

/// Hit of a ray on the seabed, and the history of its bundle of sound. Times and lengths are one
/// way.
struct Hit {
  frames::Vec3 position_enu_m = frames::Vec3::Zero();
  Eigen::Vector3f normal_enu = Eigen::Vector3f::UnitZ();   // of the facet, unit, towards the ray's origin
  Eigen::Vector3f arrival_enu = Eigen::Vector3f::UnitZ();  // direction of travel at the hit, unit
  float range_m = 0.0F;                                    // straight distance from the head; 0 is a miss
  float travel_time_s = 0.0F;
  float path_length_m = 0.0F;     // along the path: range_m when it is straight
  float tube_m2 = 0.0F;           // area of the bundle, across it, per steradian of launch: range_m^2 when straight
  float sin_grazing = 0.0F;       // sine of the angle between arrival_enu and the facet's plane, 0..1
  float facet_m = 0.0F;           // spacing of the posts of the mesh there: a facet is half a square of it. Of an
                                  // irregular mesh, what its mean triangle is half a square of
  std::uint32_t tile = 0;         // of the scene, as Object and ShownBody have it; 0: none
  std::uint32_t contributor = 0;  // that sends back, by the direct path

  bool hit() const { return range_m > 0.0F; }
};

struct Hits : Batch<Hits, Hit> {
  VectorColumns<double> position_enu_m;
  VectorColumns<float> normal_enu, arrival_enu;
  std::vector<float> range_m, travel_time_s, path_length_m, tube_m2, sin_grazing, facet_m;
  std::vector<std::uint32_t> tile, contributor;

  template <class Self>
  static auto columns(Self& self) {
    auto& place = self.position_enu_m;
    auto &normal = self.normal_enu, &arrival = self.arrival_enu;
    return std::tie(self.range_m, self.travel_time_s, self.path_length_m, self.tube_m2, self.sin_grazing, self.facet_m,
                    self.tile, self.contributor, place.x, place.y, place.z, normal.x, normal.y, normal.z, arrival.x,
                    arrival.y, arrival.z);
  }
  bool hit(std::size_t i) const { return range_m[i] > 0.0F; }
  Hit operator[](std::size_t i) const {
    return {position_enu_m[i], normal_enu[i],  arrival_enu[i], range_m[i], travel_time_s[i], path_length_m[i],
            tube_m2[i],        sin_grazing[i], facet_m[i],     tile[i],    contributor[i]};
  }
  void set(std::size_t i, const Hit& hit) {
    position_enu_m.set(i, hit.position_enu_m);
    normal_enu.set(i, hit.normal_enu);
    arrival_enu.set(i, hit.arrival_enu);
    range_m[i] = hit.range_m;
    travel_time_s[i] = hit.travel_time_s;
    path_length_m[i] = hit.path_length_m;
    tube_m2[i] = hit.tube_m2;
    sin_grazing[i] = hit.sin_grazing;
    facet_m[i] = hit.facet_m;
    tile[i] = hit.tile;
    contributor[i] = hit.contributor;
  }
};

/// ENU z of what lies lowest and highest.
struct Heights {
  double lowest_m = 0.0;
  double highest_m = 0.0;
};

/// Something small: cells of a tile, from the first to before the end, and a box around those without holes.
struct Object {
  Eigen::AlignedBox3d box_enu_m;
  const terrain::Tile* tile = nullptr;  // while the scene has it
  std::uint32_t number = 0;             // of the tile: from 1, as they came
  std::int32_t first_column = 0, first_row = 0, end_column = 0, end_row = 0;
};

/// A surface of triangles that is no lattice: a quay wall, a survey as a TIN, a scanned coral. All of one sediment
/// class.
struct IrregularMesh {
  progressive::Hierarchy hierarchy;
  std::uint8_t sediment = 0;
};

/// Level of detail of a scene's tiles (docs/physics/mesh/level-of-detail.md).
struct LevelOfDetail {
  bool enabled = false;                   // by views; off: all tiles at full detail
  std::int32_t side_lobes = 2;            // level, 0..5: side lobes see every 2^level-th post
  std::int32_t adaptations_per_ping = 1;  // adaptations that make a ping: what one has used is kept for the next ping's

  bool operator==(const LevelOfDetail&) const = default;
};

class Scene;

/// The triangles of a ping, as Scene::adapted makes them: what rays are traced against. A value whose copies share the
/// triangles. It stays as it is while its scene takes tiles in, gives some up or is adapted to the next ping.
class Mesh {
 public:
  /// Nothing to hit.
  Mesh() = default;

  /// The first facet that each ray hits within max_range_m of water where rays are straight. hits is resized to rays
  /// and overwritten. sound_speed_mps gives the travel times, nothing else. Rays pass all facets of the contributor
  /// `behind`, so that they hit what it hides; what lies within 1 mm of it along the ray is passed too. Behind
  /// kAllBodies they pass those of every body, and nothing else.
  void trace(const frames::HeadPose& head, const Rays& rays, float max_range_m, Hits& hits,
             double sound_speed_mps = 1500.0, std::uint32_t behind = kNoise) const;

  /// The first facet that each ray hits on its refracted path, at most max_range_m long. A path takes one look-up in
  /// the table down to the highest geometry within reach, and goes on from there leg by leg; a leg is hit as chords
  /// that stay within 1 mm of its arc. Rays that turn, or go up and come back, are followed to their end. paths is what
  /// `tabulate` made for this head; with a table that reaches deeper than the highest geometry every path is followed
  /// leg by leg from the head, right but slow.
  void trace(const frames::HeadPose& head, const Rays& rays, float max_range_m, Hits& hits,
             const refraction::PathTable& paths, std::uint32_t behind = kNoise) const;

  /// The table of paths from a head, down to the highest geometry within max_range_m of it. The head's depth below the
  /// water surface gives where in the profile it is.
  void tabulate(const refraction::SoundSpeedProfile& profile, const frames::HeadPose& head, double head_depth_m,
                float max_range_m, refraction::PathTable& paths) const;

  /// Of the scene, as they were.
  std::span<const Object> objects() const;
  std::span<const ShownBody> bodies() const;  // by number
  const Contributors& contributors() const;   // whose indices hits carry
  std::span<const double> facet_mean_square_slope() const;

 private:
  friend Scene;
  struct Content;
  std::shared_ptr<const Content> content_;
  std::shared_ptr<const std::vector<double>> facet_mean_square_slope_;
};

/// Seabed tiles, and irregular meshes and bodies that stand among them, of which meshes to trace rays against are made.
///
/// A tile is cut into blocks; a block is one Embree scene of grid primitives (two triangles per cell), built when it is
/// first needed, and the parts of a mesh stand under one tree. Blocks and tiles share the bits of their edges and the
/// intersection is watertight, so no ray passes between neighbours (a test aims at the seams). A cell that touches a
/// hole (NaN post) has no triangles. Embree computes in float, relative to `origin_enu_m`: keep it within 4 km of the
/// tiles and the head, where a coordinate rounds by less than 0.13 mm. Positions of hits are double.
///
/// What a ray hits depends on the tiles, the pose, the rays and the views; never on the order of insertion, on earlier
/// adaptations or the number of threads.
class Scene {
 public:
  explicit Scene(const frames::Vec2& origin_enu_m, const LevelOfDetail& detail = {});
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  /// Adds or replaces a tile. Throws std::invalid_argument with terrain::fault_of when its sizes do not fit.
  void insert(const terrain::TileKey& key, terrain::Tile tile);

  /// Takes a tile away; false when there was none.
  bool remove(const terrain::TileKey& key);

  /// Adds or replaces an irregular mesh, by a number of the caller's. Throws std::invalid_argument with
  /// progressive::fault_of.
  void insert(std::int64_t number, IrregularMesh mesh);

  /// Takes an irregular mesh away; false when there was none.
  bool remove(std::int64_t number);

  /// Adds or replaces a body, by a number of the caller's that also says its contributor. Bodies are always at full
  /// detail. Throws std::invalid_argument for a mesh with a fault (progressive::fault_of), or bulges that are not one
  /// for each triangle.
  void insert_body(std::uint32_t number, Body body);

  /// Takes a body away; false when there was none.
  bool remove_body(std::uint32_t number);

  /// Mean square of facets' slopes that a sediment's law counts too, by class (seabed::MeshedSediment): kept for
  /// those who ask how strongly hits scatter, the scene itself makes nothing of it. Empty: none is known.
  void set_facet_mean_square_slope(std::span<const double> by_class);
  /// Omissions of an adaptation to views: tiles of less than 64 cells a side, and of tiles with holes the blocks of 16
  /// x 16 cells that are not whole or stand beside such, as far as they are there. In key order. Small tiles are always
  /// at full detail.
  std::span<const Object> objects() const;

  /// Moves the origin of Embree's coordinates to the corner of a lattice of 2048 m that is nearest to a place; when
  /// that is another one, everything is built anew. So the place of a head says by how much coordinates are rounded,
  /// whatever way it took.
  void centre_near(const frames::Vec2& place_enu_m);

  /// The mesh for these views: each block as fine as the finest view that intersects it asks for, coarsest elsewhere,
  /// and irregular meshes likewise. A ray within a view of level 0 hits what it would hit with all tiles at full
  /// detail, to the bit. Without level of detail it is all of them, and no view is needed. Embree's coordinates are
  /// centred near the first view's apex. Blocks that no view intersects are built when a ray comes to them. Those that
  /// were seen lately are kept for the next mesh, coarse ones as long as no more than a fiftieth of the tiles'
  /// triangles is held: memory, which changes no mesh. Threads may ask at once, while no tile comes or goes.
  Mesh adapted(std::span<const lod::View> views = {}) const;

  const LevelOfDetail& detail() const;
  /// In memory, ready for rays.
  std::size_t triangles() const;

  /// Of tiles.
  bool empty() const;
  std::size_t size() const;
  bool contains(const terrain::TileKey& key) const;
  const frames::Vec2& origin_enu_m() const;

  /// Height by the tiles' own posts, whatever the mesh; empty over a hole or no tile.
  std::optional<double> height_m(const frames::Vec2& place_enu_m) const;

  /// Over the tiles and irregular meshes within a horizontal distance of a place; empty when there are none.
  std::optional<Heights> heights_near(const frames::Vec2& place_enu_m, double radius_m) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ensonify::trace
