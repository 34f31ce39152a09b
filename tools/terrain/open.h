#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/terrain/source_of.h"

namespace ensonify::terrain_tool {

/// A seabed from a scenario file, or from the folder of a tile set.
struct Opened {
  std::unique_ptr<source::TerrainSource> terrain;
  double spacing_m = 1.0, lsb_m = 2e-4;
  std::vector<SeabedMesh> meshes;  // that the scenario names
  std::uint64_t seed = 0;
  std::optional<LayeredSeabed> layered;  // of a generated one
};
Opened open_seabed(const std::string& scenario_or_folder);

}  // namespace ensonify::terrain_tool
