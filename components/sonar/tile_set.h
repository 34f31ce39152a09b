#pragma once

#include "kernels/acoustics/trace/scene.h"
#include "kernels/base/frames/attitude.h"
#include "messages/terrain.h"

namespace ensonify {

/// The tiles and meshes that a head holds, ready for rays.
class TileSet {
 public:
  explicit TileSet(const trace::LevelOfDetail& detail = {}) : scene_(frames::Vec2::Zero(), detail) {}

  void insert(const msg::Tile& tile);
  void release(const msg::TileRelease& release);
  void insert(const msg::Mesh& mesh);
  void release(const msg::MeshRelease& release);

  /// Whether a tile lies under the place.
  bool covers(const frames::Vec2& place_enu_m) const;
  trace::Scene& scene() { return scene_; }
  const trace::Scene& scene() const { return scene_; }

 private:
  trace::Scene scene_;
  terrain::TileGrid grid_;  // of the tiles held
};

}  // namespace ensonify
