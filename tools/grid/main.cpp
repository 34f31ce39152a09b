// ensonify grid: the depths of a survey on a grid, as a GeoTIFF or a BAG.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "components/errors/exit_error.h"
#include "components/runtime/tool.h"
#include "tools/grid/gridding.h"
#include "tools/grid/product.h"

namespace {

using namespace ensonify;
using namespace ensonify::grid_tool;

struct Options {
  std::vector<std::string> files, out{"grid.tif"};
  std::string points, tide;
  ReadOptions reading;
  double cell_m = 0.0;
  std::string crs;
  bool json = false;
};

using Writer = void (*)(const std::string&, const survey_grid::SoundingGrid&, const ProductFacts&);

Writer writer_of(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  if (ending == ".tif" || ending == ".tiff") return write_geotiff;
  if (ending == ".bag") return write_bag;
  throw UserError("--out " + file + ": is no known kind of file; allowed: .tif or .bag");
}

std::vector<std::unique_ptr<SoundingFile>> opened(Options options) {
  if (!options.tide.empty()) options.reading.tide = formats::Tide(options.tide);
  std::vector<std::unique_ptr<SoundingFile>> files;
  for (const std::string& file : options.files) files.push_back(open_file(file, options.reading));
  if (!options.points.empty()) files.push_back(open_points(options.points));
  if (options.reading.tide && options.files.empty())
    throw UserError("--tide " + options.tide + ": points are taken as they are; allowed: with .all and .kmall files");
  if (files.empty()) throw UserError("FILE: is missing; allowed: records with soundings, .all and .kmall files");
  return files;
}

/// What the grid holds, as JSON.
nlohmann::ordered_json summary_of(const Gridded& gridded) {
  const auto frame = gridded.grid.frame();
  double shoalest_m = INFINITY, deepest_m = -INFINITY;
  std::uint64_t cells = 0;
  gridded.grid.each([&](std::int64_t, std::int64_t, const survey_grid::CellSums& cell) {
    ++cells;
    shoalest_m = std::min(shoalest_m, cell.shoalest_m());
    deepest_m = std::max(deepest_m, cell.deepest_m());
  });
  nlohmann::ordered_json json;
  json["soundings"] = gridded.grid.soundings();
  json["left_out"] = gridded.left_out;
  json["cell_m"] = gridded.grid.cell_m();
  json["columns"] = frame.columns;
  json["rows"] = frame.rows;
  json["cells_with_soundings"] = cells;
  json["shoalest_m"] = shoalest_m;
  json["deepest_m"] = deepest_m;
  json["datum"] = gridded.facts.datum;
  return json;
}

int run(const Options& options) {
  for (const std::string& file : options.out) writer_of(file);
  const Gridded gridded =
      grid_of(opened(options), {options.cell_m > 0.0 ? std::optional(options.cell_m) : std::nullopt, options.crs});
  if (interrupted()) return kExitInterrupted;  // part of the soundings is no survey: nothing is written
  if (gridded.grid.soundings() == 0) throw UserError("the files hold no accepted sounding");
  for (const std::string& file : options.out) writer_of(file)(file, gridded.grid, gridded.facts);
  const auto summary = summary_of(gridded);
  if (options.json) {
    fmt::print("{}\n", summary.dump(2));
    return kExitOk;
  }
  fmt::print("{} soundings in {} cells of {:g} m, depth {:.2f} to {:.2f} m from {}: {}\n", gridded.grid.soundings(),
             summary["cells_with_soundings"].get<std::uint64_t>(), gridded.grid.cell_m(),
             summary["shoalest_m"].get<double>(), summary["deepest_m"].get<double>(),
             gridded.facts.datum.empty() ? "an unstated datum" : gridded.facts.datum, fmt::join(options.out, ", "));
  if (gridded.left_out > 0)
    fmt::print("left out: {} soundings without a position, or beyond the reach of the grid's map\n", gridded.left_out);
  return kExitOk;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Grids the accepted soundings of records: weighted mean, shoalest, number, standard deviation and uncertainty "
      "of\n"
      "each cell, as a GeoTIFF, or elevation and uncertainty as a BAG. Cells without soundings stay open.\n"
      "Exit code: 0 done, 2 wrong input, 5 the file cannot be written, 130 interrupted: nothing is written.",
      "ensonify grid");
  Options options;
  app.add_option("FILE", options.files, "records with soundings/1, runs' folders with one, .all and .kmall files");
  app.add_option("--out,-o", options.out, "file to write, .tif or .bag; may be given again")
      ->allow_extra_args(false)
      ->capture_default_str();
  app.add_option("--cell", options.cell_m,
                 "side of the cells, m (default: 5 % of the depth, rounded down, at least 0.1)")
      ->check(CLI::Range(1e-3, 1e5));
  app.add_option("--crs", options.crs,
                 "map of the grid: utm, or one in metres that GDAL knows, such as EPSG:32619\n"
                 "(default: transverse Mercator about the origin of the first file)");
  app.add_option("--soundings", options.reading.topics, "topic of soundings; may be given again (default: all)")
      ->allow_extra_args(false);
  app.add_flag("--turns", options.reading.turns, "also what was sounded in turns, run-ins and run-outs");
  app.add_option("--tide", options.tide,
                 "water level above chart datum, for .all and .kmall: lines of UTC and m, 2025-06-01T12:00:00Z,1.35\n"
                 "(default: depths count from the water line)");
  app.add_option("--points", options.points,
                 "points from another program, - for standard input: x, y, depth and its standard deviation (NaN:\n"
                 "not stated) of each as doubles");
  app.add_flag("--json", options.json, "print JSON");
  return tool_main(app, argc, argv, [&] { return run(options); });
}
