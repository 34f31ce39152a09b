#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <tuple>
#include <vector>

#include "components/errors/exit_error.h"
#include "components/terrain/layered_seabed.h"
#include "components/terrain/tile_set_source.h"
#include "components/terrain/tiles/file_bytes.h"
#include "components/terrain/tiles/tile_set.h"
#include "kernels/base/frames/local_projection.h"
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

using nlohmann::ordered_json;

struct MarksOptions {
  std::string seabed;
  int points = 21;
  bool geojson = false;
};

std::string csv_of(const std::vector<source::NamedMark>& marks, int points) {
  std::string text = "layer,mark,east_m,north_m,length_m,half_width_m,depth_m\n";
  for (std::size_t number = 0; number < marks.size(); ++number) {
    const auto& [layer, mark] = marks[number];
    for (const frames::Vec2& place : relief::line_of(mark, points))
      text += fmt::format("{},{},{:.3f},{:.3f},{:.3f},{:.3f},{:.4f}\n", layer, number, place.x(), place.y(),
                          mark.length_m, mark.half_width_m, mark.depth_m);
  }
  return text;
}

std::string geojson_of(const std::vector<source::NamedMark>& marks, int points, const frames::Geodetic& origin) {
  const frames::LocalProjection projection(origin);
  ordered_json features = ordered_json::array();
  for (std::size_t number = 0; number < marks.size(); ++number) {
    const auto& [layer, mark] = marks[number];
    ordered_json line = ordered_json::array();
    for (const frames::Vec2& place : relief::line_of(mark, points)) {
      const frames::Geodetic there = projection.geodetic_of(place);
      line.push_back({there.longitude_deg, there.latitude_deg});
    }
    features.push_back({{"type", "Feature"},
                        {"properties",
                         {{"layer", layer},
                          {"mark", number},
                          {"length_m", mark.length_m},
                          {"half_width_m", mark.half_width_m},
                          {"depth_m", mark.depth_m}}},
                        {"geometry", {{"type", "LineString"}, {"coordinates", line}}}});
  }
  return ordered_json{{"type", "FeatureCollection"}, {"features", features}}.dump(1) + "\n";
}

int marks(const MarksOptions& options) {
  const Opened seabed = open_seabed(options.seabed);
  if (!seabed.layered) throw UserError(options.seabed + ": is no seabed of layers; only those have marks");
  const auto found = source::marks_of(*seabed.layered, seabed.spacing_m);
  fmt::print("{}", options.geojson ? geojson_of(found, options.points, seabed.terrain->origin())
                                   : csv_of(found, options.points));
  return kExitOk;
}

struct SampleOptions {
  std::string seabed, points;
  double spacing_m = 0.0;  // 0: the seabed's own
};

/// A line of the points file: two numbers with a comma, blanks allowed; nothing for an empty one.
std::optional<frames::Vec2> point_of(const std::string& line, const std::string& place) {
  if (line.find_first_not_of(" \t\r") == std::string::npos) return std::nullopt;
  std::istringstream stream(line);
  double east_m = 0.0, north_m = 0.0;
  char comma = 0;
  if (!(stream >> east_m >> comma >> north_m) || comma != ',' || !std::isfinite(east_m) || !std::isfinite(north_m) ||
      !(stream >> std::ws).eof()) {
    throw UserError(place + ": is no place; allowed: east_m,north_m as two numbers");
  }
  return frames::Vec2(east_m, north_m);
}

/// The four by four posts around a place, as a mesh of them has them.
terrain::Tile posts_around(const Opened& seabed, double spacing_m, const frames::Vec2& place) {
  constexpr int kPosts = 4;
  const auto before = [&](double m) { return static_cast<std::int64_t>(std::floor(m / spacing_m)) - 1; };
  const source::PostBlock block{before(place.x()), before(place.y()), kPosts, kPosts, spacing_m};
  terrain::Tile tile{{block.east_m(0), block.north_m(0)}, spacing_m, kPosts, kPosts, {}, {}};
  tile.height_m.resize(block.size());
  tile.sediment.resize(block.size());
  seabed.terrain->sample(block, tile.height_m, tile.sediment);
  for (float& height : tile.height_m) height = terrain::on_lattice(height, seabed.lsb_m);
  return tile;
}

/// Bilinear. NaN where a post that has a part in it is none.
double height_at_m(const terrain::Tile& posts, const frames::Vec2& place) {
  const frames::Vec2 at = (place - posts.origin_enu_m) / posts.spacing_m;
  const auto before = [](double posts_on) { return std::clamp(static_cast<int>(std::floor(posts_on)), 0, 2); };
  const int column = before(at.x()), row = before(at.y());
  const double east = at.x() - column, north = at.y() - row;
  double height_m = 0.0;
  for (const auto& [c, r, share] : {std::tuple{0, 0, (1.0 - east) * (1.0 - north)},
                                    {1, 0, east * (1.0 - north)},
                                    {0, 1, (1.0 - east) * north},
                                    {1, 1, east * north}}) {
    if (share > 0.0) height_m += share * static_cast<double>(posts.height_m[posts.post(column + c, row + r)]);
  }
  return height_m;
}

/// Steepest descent of the surface between the posts, by differences of one post to either side.
double slope_deg(const terrain::Tile& posts, const frames::Vec2& place) {
  const double step_m = posts.spacing_m;
  const frames::Vec2 east(step_m, 0.0), north(0.0, step_m);
  return std::atan(std::hypot(height_at_m(posts, place + east) - height_at_m(posts, place - east),
                              height_at_m(posts, place + north) - height_at_m(posts, place - north)) /
                   (2.0 * step_m)) *
         180.0 / std::numbers::pi;
}

std::string number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "";
}

int sample(const SampleOptions& options) {
  const Opened seabed = open_seabed(options.seabed);
  const double spacing_m = options.spacing_m > 0.0 ? options.spacing_m : seabed.spacing_m;
  std::ifstream file;
  if (options.points != "-") file.open(options.points);
  std::istream& points = options.points == "-" ? std::cin : file;
  if (!points) throw UserError(options.points + ": cannot be read");
  fmt::print("east_m,north_m,elevation_m,sediment,slope_deg\n");
  std::string line;
  for (int n = 1; std::getline(points, line); ++n) {
    if (n == 1 && line.find_first_of("abcdefghijklmnopqrstuvwxyz") != std::string::npos) continue;  // a header
    const auto place = point_of(line, fmt::format("{}:{}", options.points, n));
    if (!place) continue;
    const terrain::Tile around = posts_around(seabed, spacing_m, *place);
    const double height_m = height_at_m(around, *place);
    const std::string sediment = std::isfinite(height_m) ? std::to_string(terrain::sediment_at(around, *place)) : "";
    fmt::print("{},{},{},{},{}\n", place->x(), place->y(), number(height_m, 4), sediment,
               number(slope_deg(around, *place), 2));
  }
  return kExitOk;
}

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

Verb add_info(CLI::App& parent) {
  return add(parent, "info", "Says what a tile set holds: extent, depths, posts, step, bytes.", info);
}

Verb add_verify(CLI::App& parent) {
  return add(
      parent, "verify",
      "Reads every tile: checksums, sidecars, world files, posts that neighbours share. Exit code 1 for a fault.",
      verify);
}

Verb add_marks(CLI::App& parent) {
  auto options = std::make_shared<MarksOptions>();
  CLI::App* app = parent.add_subcommand(
      "marks",
      "Prints the middle lines of a generated seabed's trawl scars and anchor drags, the ground truth for who searches "
      "for them, as CSV in m from the origin. Listed is what lies in the seabed (furrows of a pair follow each other, "
      "but one may lie outside), whether or not a mask, later layers or its age hide it; depth_m is what is left of "
      "it.");
  app->add_option("seabed", options->seabed, "scenario file")->required();
  app->add_option("--points", options->points, "of each line, from end to end")->check(CLI::Range(2, 10'000));
  app->add_flag("--geojson", options->geojson, "line strings in longitude and latitude instead");
  return {app, [options] { return marks(*options); }};
}

Verb add_sample(CLI::App& parent) {
  auto options = std::make_shared<SampleOptions>();
  CLI::App* app = parent.add_subcommand(
      "sample",
      "Prints elevation (m, up from chart datum), sediment class and slope at given places as CSV; empty where there "
      "is "
      "no seabed. Heights are those of the mesh between posts; the slope is that over one post to either side.");
  app->add_option("seabed", options->seabed, "scenario file, or folder of a tile set")->required();
  app->add_option("--spacing", options->spacing_m,
                  "of the posts, m, for a coarser mesh or a finer one (default: the seabed's own)")
      ->check(CLI::Range(0.001, 1e5));
  app->add_option("--points", options->points, "CSV of east_m,north_m, with or without a header; - for standard input")
      ->required();
  return {app, [options] { return sample(*options); }};
}

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
