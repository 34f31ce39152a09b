#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <fstream>
#include <iostream>
#include <memory>
#include <numbers>
#include <sstream>

#include "components/runtime/exit_error.h"
#include "components/runtime/terrain/tile_set_source.h"
#include "tools/terrain/verbs.h"

namespace ensonify::terrain_tool {
namespace {

struct Options {
  std::string folder, points;
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

/// Steepest descent of the surface between the posts, by differences of one post to either side.
double slope_deg(const source::TileSetSource& source, const frames::Vec2& place) {
  const double step_m = source.native_spacing_m();
  const double east =
      source.height_m({place.x() + step_m, place.y()}) - source.height_m({place.x() - step_m, place.y()});
  const double north =
      source.height_m({place.x(), place.y() + step_m}) - source.height_m({place.x(), place.y() - step_m});
  return std::atan(std::hypot(east, north) / (2.0 * step_m)) * 180.0 / std::numbers::pi;
}

std::string number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "";
}

int sample(const Options& options) {
  const source::TileSetSource source(options.folder);
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
    const double height_m = source.height_m(*place);
    const std::string sediment = std::isfinite(height_m) ? std::to_string(source.sediment(*place)) : "";
    fmt::print("{},{},{},{},{}\n", place->x(), place->y(), number(height_m, 4), sediment,
               number(slope_deg(source, *place), 2));
  }
  return kExitOk;
}

}  // namespace

Verb add_sample(CLI::App& parent) {
  auto options = std::make_shared<Options>();
  CLI::App* app = parent.add_subcommand(
      "sample",
      "Prints elevation (m, up from chart datum), sediment class and slope at given places as CSV; empty where the set "
      "has no seabed. The slope is that over one post to either side.");
  app->add_option("folder", options->folder, "folder of the tile set")->required();
  app->add_option("--points", options->points, "CSV of east_m,north_m, with or without a header; - for standard input")
      ->required();
  return {app, [options] { return sample(*options); }};
}

}  // namespace ensonify::terrain_tool
