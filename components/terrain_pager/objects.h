#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "components/terrain/object_meshes.h"
#include "components/terrain/terrain_source.h"
#include "components/terrain_pager/config.h"
#include "components/terrain_pager/mission_track.h"
#include "kernels/mesh/paging/rules.h"
#include "messages/terrain.h"

namespace ensonify::pager {

/// The scenario's objects where they stand, and which of them heads hold: by the same margins as meshes. A few are
/// placed at once; of many each is placed when heads are to hold it first, so that the start does not wait for them.
class Objects {
 public:
  /// Throws ConfigError for an object outside the terrain or over a hole in it, above the water, wholly below the
  /// seabed, or in the way of the mission (as Meshes); of many when it is placed. `terrain` stays.
  Objects(const TerrainPagerConfig& config, const source::TerrainSource& terrain);

  struct Decision {
    std::vector<const msg::ObjectMesh*> meshes;  // of the objects that follow, each once in a run
    std::vector<const msg::Object*> publish;     // in the scenario's order
    std::vector<std::int64_t> release;
  };
  /// An update for where the vehicle is.
  Decision update(const frames::Vec2& place_enu_m, const paging::Margins& margins);

  std::size_t count() const { return objects_.size(); }
  std::size_t mesh_count() const { return meshes_.size(); }
  /// Of a mesh's message.
  std::size_t max_bytes() const;
  /// What was guessed or mended of meshes, a line each.
  const std::vector<std::string>& said() const { return said_; }

  static constexpr std::size_t kPlacedAtOnce = 500;  // some milliseconds each, for their ground

 private:
  struct One {
    SceneObject wanted;
    std::optional<msg::Object> message;  // once it is placed
    paging::Box box;                     // seen from above; before that about its middle, as far as it may reach
    bool at_heads = false;
  };
  struct Shape {
    msg::ObjectMesh message;
    bool at_heads = false;
  };
  void read_mesh(const source::ObjectMeshFile& file, const std::string& name);
  void place(One& one);
  void place_all(const std::vector<One*>& wanted);

  const source::TerrainSource& terrain_;
  std::optional<MissionTrack> track_;
  source::ObjectMeshes files_;
  std::vector<One> objects_;
  std::vector<Shape> meshes_;  // by their numbers
  std::vector<std::string> said_;
};

}  // namespace ensonify::pager
