#pragma once

#include <string>

#include "components/terrain/terrain_source.h"
#include "components/terrain/tiles/tile_set.h"

namespace CLI {
class App;
}

namespace ensonify::terrain_tool {

/// Options common to the verbs that write tiles.
struct BakeOptions {
  std::string folder;
  int cells = 1024;
  int threads;

  BakeOptions();
  void add_to(CLI::App& app);  // all but the folder
};

/// Takes a folder for the tiles that follow from `source_text`: one that was begun with the same text is gone on with;
/// any other that holds tiles is left alone (UserError).
void claim(const std::string& folder, const std::string& source_text);

/// Makes the tiles of a claimed folder that are missing, in parallel (which thread makes a tile changes nothing in it),
/// and writes the manifest last. `what` is what the user gave, for messages. False after Ctrl-C: the next call goes on
/// from there. Throws UserError when a tile or the disk refuses, or when there is no height anywhere.
bool bake(const source::TerrainSource& source, const std::string& what, int threads, tiles::TileSet& set);

}  // namespace ensonify::terrain_tool
