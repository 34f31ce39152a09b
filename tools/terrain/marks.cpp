// The marks of a generated seabed, as lines.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "components/errors/exit_error.h"
#include "components/terrain/layered_seabed.h"
#include "kernels/base/frames/local_projection.h"
#include "tools/terrain/verbs.h"

namespace ensonify::terrain_tool {
namespace {

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

}  // namespace

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

}  // namespace ensonify::terrain_tool
