// A seabed at given positions.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <fstream>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>

#include "components/errors/exit_error.h"
#include "tools/terrain/verbs.h"

namespace ensonify::terrain_tool {
namespace {

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

}  // namespace

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

}  // namespace ensonify::terrain_tool
