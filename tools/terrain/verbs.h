#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/terrain/source_of.h"
#include "scenarios/world/objects.h"

namespace CLI {
class App;
}

namespace ensonify::terrain_tool {

/// One verb of `ensonify terrain`: asked for when its subcommand was parsed; run gives the exit code.
struct Verb {
  CLI::App* app;
  std::function<int()> run;
};

Verb add_build(CLI::App& parent);
Verb add_facets(CLI::App& parent);
Verb add_grid(CLI::App& parent);
Verb add_import(CLI::App& parent);
Verb add_info(CLI::App& parent);
Verb add_lod(CLI::App& parent);
Verb add_marks(CLI::App& parent);
Verb add_mesh(CLI::App& parent);
Verb add_objects(CLI::App& parent);
Verb add_plot(CLI::App& parent);
Verb add_sample(CLI::App& parent);
Verb add_truth(CLI::App& parent);
Verb add_verify(CLI::App& parent);

/// A seabed from a scenario file, or from the folder of a tile set.
struct Opened {
  std::unique_ptr<source::TerrainSource> terrain;
  double spacing_m = 1.0, lsb_m = 2e-4;
  std::vector<SeabedMesh> meshes;  // that the scenario names
  std::vector<SceneObject> objects;
  std::uint64_t seed = 0;
  std::optional<LayeredSeabed> layered;  // of a generated one
};
Opened open_seabed(const std::string& scenario_or_folder);

}  // namespace ensonify::terrain_tool
