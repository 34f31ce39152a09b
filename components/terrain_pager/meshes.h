#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "components/terrain/prepared_mesh.h"
#include "components/terrain/terrain_source.h"
#include "components/terrain_pager/config.h"
#include "kernels/mesh/paging/rules.h"
#include "messages/terrain.h"

namespace ensonify::pager {

/// The scenario's meshes, and which of them heads hold: as with tiles, those nearer than the feed margin, until they
/// are farther than the release margin. All are in memory from the start.
class Meshes {
 public:
  /// Throws ConfigError for a mesh that cannot be read, that has nothing within the terrain or stands in the way of a
  /// mission's lines, their run-ins and run-outs, or orbits, and for more than head_budget_mb of them. What follows the
  /// bottom is judged as if at the surface.
  /// What of them has been made before is in `made`, by name, and what is made now is added, unless it is large.
  using Made = std::map<std::string, std::shared_ptr<const source::PlacedMesh>>;
  Meshes(const TerrainPagerConfig& config, const source::TerrainSource& terrain, Made& made);

  struct Decision {
    std::vector<const msg::Mesh*> publish;  // in the scenario's order
    std::vector<std::int64_t> release;
  };
  /// An update for where the vehicle is.
  Decision update(const frames::Vec2& place_enu_m, const paging::Margins& margins);

  /// Size of the largest one, as a message.
  std::size_t max_bytes() const;
  std::size_t count() const { return meshes_.size(); }
  /// Names of those whose splits had to be made at the start and are many.
  const std::vector<std::string>& unprepared() const { return unprepared_; }

 private:
  struct One {
    msg::Mesh message;
    paging::Box box;  // seen from above
    bool at_heads = false;
  };
  std::vector<One> meshes_;
  std::vector<std::string> unprepared_;
};

}  // namespace ensonify::pager
