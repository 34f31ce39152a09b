// What a tile set holds, and whether it is whole.
#include "components/terrain/tiles/tile_set.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "components/errors/exit_error.h"
#include "components/terrain/tile_set_source.h"
#include "components/terrain/tiles/faults.h"
#include "components/terrain/tiles/overview.h"
#include "tools/terrain/verbs.h"

namespace ensonify::terrain_tool {
namespace {

struct SetOptions {
  std::string folder;
  bool json = false;
};

std::uintmax_t bytes_of(const std::string& folder) {
  std::uintmax_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) bytes += entry.file_size();
  }
  return bytes;
}

int info(const SetOptions& options) {
  const source::TileSetSource source(options.folder);
  const tiles::TileSet& set = source.set();
  const source::Extent extent = source.extent();
  std::int64_t holes = 0;
  for (const auto& [key, facts] : set.tiles) holes += facts.holes;
  const auto side = static_cast<std::int64_t>(set.grid.cells) + 1;
  nlohmann::ordered_json facts = {{"made_from", set.made_from},
                                  {"latitude_deg", set.origin.latitude_deg},
                                  {"longitude_deg", set.origin.longitude_deg},
                                  {"tiles", set.tiles.size()},
                                  {"posts", static_cast<std::int64_t>(set.tiles.size()) * side * side},
                                  {"holes", holes},
                                  {"spacing_m", set.grid.spacing_m},
                                  {"lsb_m", set.grid.lsb_m},
                                  {"largest_error_m", 0.5 * set.grid.lsb_m},
                                  {"overview", set.overview_sha256.empty() ? "none" : tiles::kOverview},
                                  {"west_m", extent.west_m},
                                  {"south_m", extent.south_m},
                                  {"east_m", extent.east_m},
                                  {"north_m", extent.north_m},
                                  {"lowest_m", source.lowest_m()},
                                  {"highest_m", source.highest_m()},
                                  {"bytes", bytes_of(options.folder)}};
  if (options.json) {
    fmt::print("{}\n", facts.dump(2));
  } else {
    for (const auto& [key, value] : facts.items())
      fmt::print("{:<16} {}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
  }
  return kExitOk;
}

int verify(const SetOptions& options) {
  const auto faults = tiles::faults_of(tiles::open_tile_set(options.folder));
  if (options.json) {
    fmt::print("{}\n", nlohmann::ordered_json{{"faults", faults}}.dump(2));
  } else {
    for (const std::string& fault : faults) fmt::print("{}\n", fault);
    fmt::print("{}: {}\n", options.folder, faults.empty() ? "all well" : fmt::format("{} faults", faults.size()));
  }
  return faults.empty() ? kExitOk : kExitAssertionFailed;
}

Verb add(CLI::App& parent, const std::string& name, const std::string& about, int (*run)(const SetOptions&)) {
  auto options = std::make_shared<SetOptions>();
  CLI::App* app = parent.add_subcommand(name, about);
  app->add_option("folder", options->folder, "folder of the tile set")->required();
  app->add_flag("--json", options->json, "print JSON");
  return {app, [options, run] { return run(*options); }};
}

}  // namespace

Verb add_info(CLI::App& parent) {
  return add(parent, "info", "Says what a tile set holds: extent, depths, posts, step, bytes.", info);
}

Verb add_verify(CLI::App& parent) {
  return add(
      parent, "verify",
      "Reads every tile: checksums, sidecars, world files, posts that neighbours share. Exit code 1 for a fault.",
      verify);
}

}  // namespace ensonify::terrain_tool
