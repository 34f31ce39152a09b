#pragma once

#include <cstdint>
#include <vector>

#include "components/terrain/terrain_source.h"
#include "components/terrain_pager/config.h"
#include "kernels/mesh/paging/rules.h"
#include "messages/terrain.h"

namespace ensonify::pager {

/// The scenario's objects where they stand, and which of them heads hold: by the same margins as meshes.
class Objects {
 public:
  /// Throws ConfigError for an object outside the terrain or over a hole in it, above the water, wholly below the
  /// seabed, or in the way of the mission (as Meshes).
  Objects(const TerrainPagerConfig& config, const source::TerrainSource& terrain);

  struct Decision {
    std::vector<const msg::Object*> publish;  // in the scenario's order
    std::vector<std::int64_t> release;
  };
  /// An update for where the vehicle is.
  Decision update(const frames::Vec2& place_enu_m, const paging::Margins& margins);

  std::size_t count() const { return objects_.size(); }

 private:
  struct One {
    msg::Object message;
    paging::Box box;  // seen from above
    bool at_heads = false;
  };
  std::vector<One> objects_;
};

}  // namespace ensonify::pager
