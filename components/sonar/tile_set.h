#pragma once

#include <cstdint>
#include <map>

#include "kernels/acoustics/trace/scene.h"
#include "kernels/base/frames/attitude.h"
#include "kernels/mesh/solids/solid.h"
#include "messages/terrain.h"

namespace ensonify {

/// The tiles, meshes and objects that a head holds, ready for rays.
class TileSet {
 public:
  /// shortest_wave_m: of the head's carriers. Smooth objects are as fine as it asks for.
  explicit TileSet(const trace::LevelOfDetail& detail = {}, double shortest_wave_m = 0.01)
      : scene_(frames::Vec2::Zero(), detail), shortest_wave_m_(shortest_wave_m) {}

  void insert(const msg::Tile& tile);
  void release(const msg::TileRelease& release);
  void insert(const msg::Mesh& mesh);
  void release(const msg::MeshRelease& release);
  void insert(const msg::ObjectMesh& mesh);
  /// After the mesh that it names.
  void insert(const msg::Object& object);
  void release(const msg::ObjectRelease& release);

  /// Whether a tile lies under the place.
  bool covers(const frames::Vec2& place_enu_m) const;
  trace::Scene& scene() { return scene_; }
  const trace::Scene& scene() const { return scene_; }

 private:
  trace::Scene scene_;
  terrain::TileGrid grid_;                            // of the tiles held
  std::map<std::int64_t, solids::Mesh> object_mesh_;  // by number
  double shortest_wave_m_;
};

}  // namespace ensonify
