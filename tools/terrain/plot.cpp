// A seabed drawn, and the numbers that are drawn.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "components/errors/exit_error.h"
#include "components/terrain/tiles/file_bytes.h"
#include "kernels/base/frames/local_projection.h"
#include "tools/terrain/verbs.h"

namespace ensonify::terrain_tool {
namespace {

struct PlotOptions {
  std::string seabed, out = "seabed.png", title;
  std::vector<double> around;
};

struct GridOptions {
  std::string seabed, out;
  std::vector<double> around;
  int posts = 1000;
};

/// At most `posts` per side over a rectangle, on the seabed's own posts where it is small enough.
source::PostBlock block_of(const Opened& seabed, const GridOptions& options) {
  source::Extent extent = seabed.terrain->extent();
  if (!options.around.empty()) {
    const double half = 0.5 * options.around[2];
    extent = {options.around[0] - half, options.around[1] - half, options.around[0] + half, options.around[1] + half};
  }
  const double side = std::max(extent.east_m - extent.west_m, extent.north_m - extent.south_m);
  source::PostBlock block;
  block.spacing_m = seabed.spacing_m;  // times a power of two, so that posts are nodes of a coarser level
  while (side / block.spacing_m > options.posts) block.spacing_m *= 2.0;
  block.first_east = std::llround(extent.west_m / block.spacing_m);
  block.first_north = std::llround(extent.south_m / block.spacing_m);
  block.columns = static_cast<int>(std::llround((extent.east_m - extent.west_m) / block.spacing_m)) + 1;
  block.rows = static_cast<int>(std::llround((extent.north_m - extent.south_m) / block.spacing_m)) + 1;
  return block;
}

int grid(const GridOptions& options) {
  const Opened seabed = open_seabed(options.seabed);
  const source::PostBlock block = block_of(seabed, options);
  std::vector<float> height_m(block.size());
  std::vector<std::uint8_t> sediment(block.size());
  seabed.terrain->sample(block, height_m, sediment);
  std::vector<std::uint8_t> bytes(block.size() * 5);
  std::memcpy(bytes.data(), height_m.data(), block.size() * 4);
  std::memcpy(bytes.data() + block.size() * 4, sediment.data(), block.size());
  tiles::write_file(options.out, bytes);
  fmt::print("{}\n", nlohmann::ordered_json{{"columns", block.columns},
                                            {"rows", block.rows},
                                            {"spacing_m", block.spacing_m},
                                            {"west_m", block.east_m(0)},
                                            {"south_m", block.north_m(0)},
                                            {"latitude_deg", seabed.terrain->origin().latitude_deg},
                                            {"longitude_deg", seabed.terrain->origin().longitude_deg}}
                         .dump());
  return kExitOk;
}

/// `ensonify plot seabed`, which asks `ensonify terrain grid` for the heights.
int plot(const PlotOptions& options) {
  const auto here = std::filesystem::read_symlink("/proc/self/exe");
  const std::string program = (here.parent_path() / "ensonify-plot").string();
  std::vector<std::string> words = {program, "seabed", options.seabed, "--out", options.out};
  if (!options.title.empty()) words.insert(words.end(), {"--title", options.title});
  if (!options.around.empty()) {
    words.emplace_back("--around");
    for (const double number : options.around) words.push_back(fmt::format("{}", number));
  }
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::fflush(nullptr);
  ::execv(program.c_str(), arguments.data());
  throw UserError(program + ": cannot be run: " + std::strerror(errno));
}

void add_around(CLI::App& app, std::vector<double>& around) {
  app.add_option("--around", around, "EAST NORTH SIDE in m: a square; default: all of it")->expected(3);
}

}  // namespace

Verb add_plot(CLI::App& parent) {
  auto options = std::make_shared<PlotOptions>();
  CLI::App* app = parent.add_subcommand(
      "plot", "Draws a seabed: depth in colours under a light from the north-west, and its sediment classes.");
  app->add_option("seabed", options->seabed, "scenario file, or folder of a tile set")->required();
  app->add_option("--out", options->out, "PNG file")->capture_default_str();
  app->add_option("--title", options->title, "above the picture");
  add_around(*app, options->around);
  return {app, [options] { return plot(*options); }};
}

Verb add_grid(CLI::App& parent) {
  auto options = std::make_shared<GridOptions>();
  CLI::App* app = parent.add_subcommand(
      "grid",
      "Writes heights (float32, m, up) and then classes (bytes) of a grid, row by row from the south-west, as raw "
      "numbers; prints its size and place as JSON.");
  app->add_option("seabed", options->seabed, "scenario file, or folder of a tile set")->required();
  app->add_option("--out", options->out, "file to write")->required();
  app->add_option("--posts", options->posts, "per side, at most")->check(CLI::Range(2, 8192))->capture_default_str();
  add_around(*app, options->around);
  return {app, [options] { return grid(*options); }};
}

}  // namespace ensonify::terrain_tool
