#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "components/errors/exit_error.h"
#include "components/terrain/tiles/file_bytes.h"
#include "tools/terrain/bake.h"
#include "tools/terrain/import/mosaic.h"
#include "tools/terrain/import/survey_file.h"
#include "tools/terrain/verbs.h"

namespace ensonify::terrain_tool {
namespace {

using namespace terrain_import;

/// The command line as it was typed; its words are reported in source.yaml.
struct Words {
  std::vector<std::string> files;
  FileOptions all;  // what is said of all files
  std::string nodata, origin, bounds, fill = "none", band_start = "none", class_map, thresholds, backscatter_classes;
  ImportOptions import;
  BakeOptions bake;
};

frames::Geodetic place_of(const std::string& text) {
  const auto n = numbers_in(text, "--origin", 2, 2);
  if (!(std::abs(n[0]) < 90.0) || !(std::abs(n[1]) <= 180.0))
    throw UserError("--origin " + text + ": is no place; allowed is LATITUDE,LONGITUDE in degrees");
  return {n[0], n[1]};
}

source::GeodeticBox box_of(const std::string& text) {
  const auto n = numbers_in(text, "--bounds", 4, 4);
  const source::GeodeticBox box{n[0], n[1], n[2], n[3]};
  if (!(box.south_deg < box.north_deg) || box.west_deg == box.east_deg)
    throw UserError("--bounds " + text + ": is no box; allowed is WEST,SOUTH,EAST,NORTH in degrees");
  return box;
}

FillOptions fill_of(const std::string& text) {
  if (text == "none") return {};
  const auto slash = text.find('/');
  const std::string method = text.substr(0, slash);
  const auto reach = slash == std::string::npos ? std::nullopt : number_in(text.substr(slash + 1));
  if ((method != "idw" && method != "smooth") || !reach || !(*reach > 0.0))
    throw UserError("--fill " + text + ": is unknown; allowed are none, idw/METRES and smooth/METRES");
  return {method == "idw" ? FillOptions::Method::kIdw : FillOptions::Method::kSmooth, *reach};
}

double band_start_of(const std::string& text) {
  if (text == "none") return 0.0;
  if (text == "auto") return kBandAuto;
  const auto cells = number_in(text);
  if (!cells || !(*cells > 2.0) || *cells > 1000.0)
    throw UserError("--band-start " + text +
                    ": is unknown; allowed are none, auto and a number of cells from 2 to 1000");
  return *cells;
}

std::uint8_t class_of(double number, const std::string& option) {
  if (!(number >= 0.0 && number <= 255.0) || number != std::floor(number))
    throw UserError(fmt::format("{}: {} is no class; allowed are whole numbers from 0 to 255", option, number));
  return static_cast<std::uint8_t>(number);
}

std::map<int, std::uint8_t> class_map_of(const std::string& text) {
  std::map<int, std::uint8_t> map;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) {
    const auto equals = part.find('=');
    const auto value = number_in(part.substr(0, equals));
    const auto sediment = equals == std::string::npos ? std::nullopt : number_in(part.substr(equals + 1));
    if (!value || !sediment)
      throw UserError("--class-map " + text + ": is unknown; allowed is VALUE=CLASS,VALUE=CLASS");
    map[static_cast<int>(*value)] = class_of(*sediment, "--class-map");
  }
  return map;
}

ImportOptions import_of(const Words& words) {
  ImportOptions import = words.import;
  FileOptions all = words.all;
  if (!words.nodata.empty()) all.nodata = numbers_in(words.nodata, "--nodata", 1, 16);
  for (const auto& file : words.files) import.files.push_back(file_of(file, all));
  if (!words.origin.empty()) import.origin = place_of(words.origin);
  if (!words.bounds.empty()) import.box = box_of(words.bounds);
  import.fill = fill_of(words.fill);
  import.clean.band_start_cells = band_start_of(words.band_start);
  SedimentOptions& sediment = import.sediment;
  sediment.class_of_value = class_map_of(words.class_map);
  if (!words.thresholds.empty()) sediment.thresholds_db = numbers_in(words.thresholds, "--thresholds", 1, 254);
  if (!words.backscatter_classes.empty()) {
    for (const double number : numbers_in(words.backscatter_classes, "--backscatter-classes", 2, 255))
      sediment.backscatter_classes.push_back(class_of(number, "--backscatter-classes"));
  }
  return import;
}

/// What the tiles follow from: the command line and the bytes of all files it names.
std::string source_text(const Words& words, const ImportOptions& import, const std::vector<SurveyFile>& files) {
  std::set<std::string> names;
  for (const auto& file : files) {
    names.insert(file.files.begin(), file.files.end());
    if (!file.options.vertical.empty()) names.insert(file.options.vertical);
  }
  for (const auto& raster : {import.sediment.class_raster, import.sediment.backscatter})
    if (!raster.empty()) names.insert(file_of(raster, {}).path);
  const auto& p = import.points;
  const auto& c = import.clean;
  nlohmann::ordered_json facts = {
      {"import", words.files},
      {"crs", words.all.crs},
      {"positive", words.all.positive},
      {"units", words.all.units},
      {"nodata", words.nodata},
      {"datum_shift_m", words.all.datum_shift_m},
      {"vertical", words.all.vertical},
      {"band", words.all.band},
      {"origin", words.origin},
      {"bounds", words.bounds},
      {"spacing_m", import.spacing_m},
      {"lsb_m", import.lsb_m},
      {"cells", words.bake.cells},
      {"points", {{"method", static_cast<int>(p.method)}, {"cell", p.cell_m}}},
      {"clean", {{"despike", c.despike}, {"destripe", c.destripe}, {"band_start", words.band_start}}},
      {"fill", words.fill},
      {"sediment",
       {{"otherwise", import.sediment.otherwise},
        {"class_raster", import.sediment.class_raster},
        {"class_map", words.class_map},
        {"backscatter", import.sediment.backscatter},
        {"thresholds", words.thresholds},
        {"backscatter_classes", words.backscatter_classes},
        {"rules", import.sediment.rules}}}};
  for (const auto& name : names) {
    if (std::filesystem::is_regular_file(name)) facts["sha256"][name] = tiles::sha256_of_file(name);
  }
  return "# what these tiles were imported from\n" + facts.dump(2) + "\n";  // JSON is YAML, too
}

/// The finest of a few round steps by which 16 bits span all heights.
double step_m(const Mosaic& mosaic) {
  for (const double step : {2e-4, 5e-4, 1e-3, 2e-3, 4e-3, 1e-2, 2e-2, 5e-2, 0.1})
    if (mosaic.highest_m() - mosaic.lowest_m() < step * (static_cast<double>(tiles::kMostSteps) - 1.0)) return step;
  return 0.5;
}

int import(const Words& words) {
  const ImportOptions options = import_of(words);
  std::vector<SurveyFile> files;
  for (std::size_t i = 0; i < options.files.size(); ++i)
    files.push_back(read_survey_file(options.files[i], options, static_cast<int>(i)));
  Mosaic mosaic(files, options);
  const HoleFacts holes = fill(mosaic, options.fill);
  const ClassPosts classes = classify(mosaic, options.sediment);
  const StepFacts steps = step_facts(mosaic, options.lsb_m > 0.0 ? options.lsb_m : step_m(mosaic));
  const auto cells = cell_facts(files, mosaic, options, steps.lsb_m);
  const std::string report = report_json(files, mosaic, holes, classes, steps, cells).dump(2) + "\n";
  const std::string text = report_text(files, mosaic, holes, classes, steps, cells);

  tiles::TileSet set;
  set.folder = words.bake.folder;
  set.origin = mosaic.origin();
  set.grid = {frames::Vec2::Zero(), mosaic.native_spacing_m(), words.bake.cells, steps.lsb_m};
  for (const auto& file : files)
    set.made_from += (set.made_from.empty() ? "" : ", ") + std::filesystem::path(file.options.path).filename().string();
  try {
    claim(set.folder, source_text(words, options, files));
    tiles::write_file(set.folder + "/" + kReport, report);
  } catch (const tiles::TileError& error) {
    throw UserError(error.what());
  }
  if (!bake(mosaic, words.files.front(), words.bake.threads, set)) return kExitInterrupted;
  fmt::print("{}{}: {} tiles of {} x {} posts; {} says all of this\n", text, set.folder, set.tiles.size(),
             set.grid.cells + 1, set.grid.cells + 1, kReport);
  return kExitOk;
}

void add_file_options(CLI::App& app, Words& words) {
  app.add_option(
         "files", words.files,
         "rasters or scattered points, the best first: the first that knows a place decides. FILE?KEY=VALUE&... "
         "says of one file what the options below say of all: crs, positive, units, nodata, datum-shift, "
         "vertical, band")
      ->required();
  app.add_option("--crs", words.all.crs,
                 "reference system instead of the files' own: EPSG:..., a PROJ string, or plane");
  app.add_option("--positive", words.all.positive, "what values are: elevations (up), depths (down), or as found")
      ->check(CLI::IsMember({"auto", "up", "down"}))
      ->capture_default_str();
  app.add_option("--units", words.all.units, "unit of values: m, dm, cm, mm, ft, us-ft, fathom, or as the file says")
      ->capture_default_str();
  app.add_option("--nodata", words.nodata, "marks of missing values besides the files' own, with commas");
  app.add_option("--datum-shift", words.all.datum_shift_m, "added to elevations, m: their zero above chart datum");
  app.add_option("--vertical", words.all.vertical, "raster of what is added to elevations, m (a separation model)");
  app.add_option("--band", words.all.band, "band of the files")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--points", words.import.points.method, "how cells are made of scattered points")
      ->transform(CLI::CheckedTransformer(std::map<std::string, PointMethod>{{"mean", PointMethod::kMean},
                                                                             {"lowest", PointMethod::kLowest},
                                                                             {"highest", PointMethod::kHighest},
                                                                             {"linear", PointMethod::kLinear}}));
  app.add_option("--points-cell", words.import.points.cell_m, "side of their cells, map units (four points a cell)")
      ->check(CLI::PositiveNumber);
}

void add_world_options(CLI::App& app, Words& words) {
  app.add_option("--out", words.bake.folder, "folder of the tile set, made if need be")->required();
  app.add_option("--origin", words.origin,
                 "LATITUDE,LONGITUDE of the world's origin, degrees (the middle of the data)");
  app.add_option("--bounds", words.bounds, "WEST,SOUTH,EAST,NORTH in degrees: take only what lies there");
  app.add_option("--spacing", words.import.spacing_m, "between posts, m (the finest file's cells)")
      ->check(CLI::Range(1e-3, 1e4));
  app.add_option("--lsb-m", words.import.lsb_m, "step of heights, m (the finest that 16 bits allow, from 0.2 mm)")
      ->check(CLI::Range(1e-6, 10.0));
  words.bake.add_to(app);
  app.add_option("--fill", words.fill, "holes: none, idw/METRES, smooth/METRES (how far their middle may lie)")
      ->capture_default_str();
  app.add_flag("--despike", words.import.clean.despike, "make spikes of one cell holes");
  app.add_flag("--destripe", words.import.clean.destripe, "take straight stripes out");
  app.add_option("--band-start", words.band_start, "take out waves shorter than this: none, auto, or a number of cells")
      ->capture_default_str();
}

void add_sediment_options(CLI::App& app, Words& words) {
  SedimentOptions& sediment = words.import.sediment;
  app.add_option("--sediment", sediment.otherwise, "class of posts that nothing below decides")
      ->check(CLI::Range(0, 255))
      ->capture_default_str();
  app.add_option("--sediment-class", sediment.class_raster, "raster of classes");
  app.add_option("--class-map", words.class_map, "VALUE=CLASS,...: what the values of that raster mean");
  app.add_option("--sediment-backscatter", sediment.backscatter, "raster of backscatter, dB");
  app.add_option("--thresholds", words.thresholds, "rising dB values between the classes");
  app.add_option("--backscatter-classes", words.backscatter_classes, "those classes, one more (0,1,2,...)");
  app.add_option("--sediment-rule", sediment.rules, "CLASS:depth>30,slope<5 (m, degrees); the first that holds decides")
      ->take_all();
}

}  // namespace

Verb add_import(CLI::App& parent) {
  auto words = std::make_shared<Words>();
  CLI::App* app = parent.add_subcommand(
      "import",
      "Makes a tile set of survey files (docs/manual/import.md): any raster that GDAL reads, or scattered points. What "
      "was "
      "done "
      "and lost is printed and written to import.json. An import that was stopped goes on where it was.");
  add_file_options(*app, *words);
  add_world_options(*app, *words);
  add_sediment_options(*app, *words);
  return {app, [words] { return import(*words); }};
}

}  // namespace ensonify::terrain_tool
