#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "components/errors/exit_error.h"
#include "tools/plan/line_files.h"
#include "tools/plan/verbs.h"

namespace ensonify::plan {
namespace {

struct Options {
  std::string file, crs;
  std::optional<double> speed_mps;
  bool json = false, csv = false;
};

int import(const Options& options) {
  const LineSet set = read_lines(options.file, options.crs);
  const Numbers numbers{{"lines", static_cast<double>(set.lines.size())}};
  fmt::print("{}", plan_text(set, numbers, options.speed_mps, format_of(options.json, options.csv)));
  return kExitOk;
}

}  // namespace

Verb add_import(CLI::App& parent) {
  auto options = std::make_shared<Options>();
  CLI::App* app = parent.add_subcommand(
      "import",
      "Reads lines that survey software wrote (.lnw, .csv, .geojson, .json, .kml, .gpx) and prints a mission.");
  app->add_option("file", options->file, "the file")->required();
  app->add_option("--crs", options->crs,
                  "reference system of projected places, e.g. EPSG:32629; without it they are world metres");
  app->add_option("--speed", options->speed_mps, "speed to run the lines at, m/s")->check(CLI::Range(0.01, 30.0));
  app->add_flag("--json", options->json, "print JSON");
  app->add_flag("--csv", options->csv, "print CSV");
  return {app, [options] { return import(*options); }};
}

}  // namespace ensonify::plan
