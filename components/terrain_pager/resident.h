#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/terrain/prepared_mesh.h"
#include "components/terrain/terrain_source.h"
#include "components/terrain_pager/tile_store.h"
#include "messages/terrain.h"

namespace ensonify::pager {

/// A seabed as a whole.
struct Glance {
  msg::Chart chart;
  std::string fault;                           // of what the chart is made of
  std::vector<source::UnevenClass> uneven;     // classes whose echoes are off where a layer holds
  msg::Array<double> facet_mean_square_slope;  // goes with every tile
};

/// What a pager has made of a seabed: functions of the seabed alone, good for every epoch that has the same.
struct Resident {
  std::string seabed;  // resident_identity(); "": of none
  std::shared_ptr<const source::TerrainSource> terrain;
  std::optional<Glance> glance;
  TileStore::Tiles tiles;
  std::map<std::string, std::shared_ptr<const source::PlacedMesh>> meshes;  // by name
};

/// What the last pager of this process has left, if it is of this seabed; else nothing, and what was left goes.
Resident take_resident(const std::string& seabed);
void leave_resident(Resident resident);

}  // namespace ensonify::pager
