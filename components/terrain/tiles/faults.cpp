#include "components/terrain/tiles/faults.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>

#include "components/terrain/tiles/file_bytes.h"
#include "components/terrain/tiles/overview.h"
#include "components/terrain/tiles/tile_text.h"

namespace ensonify::tiles {
namespace {

/// The posts of one side, from the south or from the west.
struct Edge {
  std::vector<float> height_m;
  std::vector<std::uint8_t> sediment;
};

Edge edge_of(const terrain::Tile& tile, const std::function<std::size_t(int)>& post) {
  Edge edge;
  for (int i = 0; i < tile.rows; ++i) {
    edge.height_m.push_back(tile.height_m[post(i)]);
    edge.sediment.push_back(tile.sediment[post(i)]);
  }
  return edge;
}

/// Posts at which two sides of one line differ; holes are equal to holes.
int differences(const Edge& a, const Edge& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.height_m.size(); ++i) {
    const bool same = a.height_m[i] == b.height_m[i] || (std::isnan(a.height_m[i]) && std::isnan(b.height_m[i]));
    if (!same || a.sediment[i] != b.sediment[i]) ++count;
  }
  return count;
}

void compare_text(const std::string& path, const std::string& wanted, std::vector<std::string>& faults) {
  const auto bytes = read_file(path);
  if (std::string(bytes.begin(), bytes.end()) != wanted)
    faults.push_back(path + ": says something else than the manifest");
}

}  // namespace

std::vector<std::string> faults_of(const TileSet& set) {
  std::vector<std::string> faults;
  std::map<terrain::TileKey, Edge> east_edges, north_edges;  // of tiles whose neighbours come later
  for (const auto& [key, facts] : set.tiles) {               // western tiles first, in each column southern ones
    try {
      const terrain::Tile tile = read_tile(set, key);
      compare_text(set.path_of(key, ".yaml"), sidecar_text(set, key, facts), faults);
      compare_text(set.path_of(key, ".pgw"), world_file(set, key), faults);
      const auto last = tile.columns - 1;
      const std::string path = set.path_of(key, ".png");
      const auto compare = [&](std::map<terrain::TileKey, Edge>& edges, const terrain::TileKey& neighbour,
                               const Edge& own) {
        const auto found = edges.find(neighbour);
        if (found == edges.end()) return;
        if (const int count = differences(found->second, own); count > 0) {
          faults.push_back(fmt::format("{}: {} of the posts that it shares with tile ({}, {}) differ", path, count,
                                       neighbour.east, neighbour.north));
        }
        edges.erase(found);
      };
      compare(east_edges, {key.east - 1, key.north}, edge_of(tile, [&](int i) { return tile.post(0, i); }));
      compare(north_edges, {key.east, key.north - 1}, edge_of(tile, [&](int i) { return tile.post(i, 0); }));
      east_edges[key] = edge_of(tile, [&](int i) { return tile.post(last, i); });
      north_edges[key] = edge_of(tile, [&](int i) { return tile.post(i, last); });
    } catch (const TileError& error) {
      faults.emplace_back(error.what());
    }
  }
  try {
    if (!set.overview_sha256.empty()) read_overview(set);
  } catch (const TileError& error) {
    faults.emplace_back(error.what());
  }
  try {
    compare_text(set.folder + "/seabed.vrt", vrt_text(set), faults);
  } catch (const TileError& error) {
    faults.emplace_back(error.what());
  }
  return faults;
}

}  // namespace ensonify::tiles
