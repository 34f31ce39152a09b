// ensonify georeference: places the soundings of a multibeam's file anew, from what was measured.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "components/errors/exit_error.h"
#include "components/formats/tide.h"
#include "components/formats/utc.h"
#include "components/runtime/tool.h"
#include "tools/georeference/differences.h"

using namespace ensonify;
using namespace ensonify::georeference_tool;
using namespace ensonify::survey_files;

namespace {

constexpr int kTooFar = 1;

struct Options {
  std::string file, out, tide;
  std::vector<double> within_m;
  Trace trace;
  bool json = false;
};

void declare(CLI::App& app, Options& options) {
  app.add_option("FILE", options.file, ".kmall or .all file")->required();
  app.add_option("--out", options.out, "CSV file: a row for each sounding");
  app.add_option("--tide", options.tide, "a gauge's heights (CSV, or CARIS's .tid): depths from chart datum too");
  app.add_flag(
      "--profile-as-is", [&](std::int64_t given) { options.trace.surface_speed = given == 0; },
      "trace through the profile as it stands, whatever the speed measured at the face");
  app.add_option("--within", options.within_m,
                 "most that 95 % of soundings may be off their recorded places, m: vertically, horizontally; else exit "
                 "code 1")
      ->expected(2)
      ->type_name("V H");
  app.add_flag("--json", options.json, "print an object");
}

/// Rows of soundings.
class Table {
 public:
  Table(const std::string& file, const std::optional<formats::Tide>& tide)
      : file_(file), tide_(tide), to_(std::fopen(file.c_str(), "w")) {
    if (!to_) throw UserError(file + ": cannot be written");
    fmt::print(to_.get(),
               "time_utc,ping,head,sounding,latitude_deg,longitude_deg,depth_m,height_m,forward_m,starboard_m,down_m,"
               "recorded_forward_m,recorded_starboard_m,recorded_down_m{}\n",
               tide_ ? ",chart_depth_m" : "");
  }

  void add(const Placed& of) {
    const formats::DayTime time = formats::day_time(of.unix_ns);
    fmt::print(
        to_.get(),
        "{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z,{},{},{},{:.9f},{:.9f},{:.4f},{},{:.4f},{:.4f},{:.4f},{:.4f},"
        "{:.4f},{:.4f}",
        time.date / 10'000, time.date / 100 % 100, time.date % 100, time.time_ms / 3'600'000,
        time.time_ms / 60'000 % 60, time.time_ms / 1'000 % 60, time.time_ms % 1'000, of.ping, of.head, of.sounding,
        of.position.latitude_deg, of.position.longitude_deg, of.depth_m,
        std::isfinite(of.height_m) ? fmt::format("{:.4f}", of.height_m) : "", of.place_m.x(), of.place_m.y(),
        of.place_m.z(), of.recorded_m.x(), of.recorded_m.y(), of.recorded_m.z());
    if (tide_) fmt::print(to_.get(), ",{:.4f}", of.depth_m - tide_->level_m(of.unix_ns));
    fmt::print(to_.get(), "\n");
  }

  void close() {
    if (std::fflush(to_.get()) != 0) throw DataLost(file_ + ": could not be written to its end");
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  const std::string& file_;
  const std::optional<formats::Tide>& tide_;
  std::unique_ptr<std::FILE, Close> to_;
};

void print(const Options& options, const Summary& summary, const Differences& differences) {
  const auto vertical = differences.vertical(), horizontal = differences.horizontal();
  if (options.json) {
    const auto spread = [](const Differences::Spread& of) {
      return nlohmann::ordered_json{{"mean_m", of.mean_m}, {"p95_m", of.p95_m}, {"largest_m", of.largest_m}};
    };
    const nlohmann::ordered_json all = {{"file", options.file},
                                        {"pings", summary.pings},
                                        {"soundings", summary.soundings},
                                        {"rejected", summary.rejected},
                                        {"without_attitude", summary.without_attitude},
                                        {"faults", summary.faults},
                                        {"vertical", spread(vertical)},
                                        {"horizontal", spread(horizontal)}};
    fmt::print("{}\n", all.dump(2));
    return;
  }
  fmt::print("{}: {} pings, {} soundings placed anew; {} rejected by the sounder, {} without attitude\n", options.file,
             summary.pings, summary.soundings, summary.rejected, summary.without_attitude);
  fmt::print("off the recorded places   mean     95 %  largest\n");
  fmt::print("vertically, down      {:+8.4f} {:8.4f} {:8.4f} m\n", vertical.mean_m, vertical.p95_m, vertical.largest_m);
  fmt::print("horizontally          {:8.4f} {:8.4f} {:8.4f} m\n", horizontal.mean_m, horizontal.p95_m,
             horizontal.largest_m);
}

int georeference(const Options& options) {
  std::optional<formats::Tide> tide;
  if (!options.tide.empty()) tide.emplace(options.tide);
  std::optional<Table> table;
  std::error_code none;
  if (std::filesystem::equivalent(options.out, options.file, none))
    throw UserError("--out " + options.out + ": is the file to be read; allowed: another");
  if (!options.out.empty()) table.emplace(options.out, tide);
  Differences differences;
  const TakePlaced take = [&](const Placed& placed) {
    differences.add(placed);
    if (table) table->add(placed);
  };
  const Summary summary = place_soundings(options.file, options.trace, take);
  if (interrupted()) return kExitInterrupted;
  if (table) table->close();
  if (summary.soundings == 0) throw UserError(options.file + ": holds no accepted sounding with attitude");
  if (summary.faults > 0)
    fmt::print(stderr, "ensonify georeference: {}: {} faults, which were passed over; ensonify info lists them\n",
               options.file, summary.faults);
  print(options, summary, differences);
  const bool good = options.within_m.empty() || (differences.vertical().p95_m <= options.within_m[0] &&
                                                 differences.horizontal().p95_m <= options.within_m[1]);
  return good ? int{kExitOk} : kTooFar;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Places the soundings of a multibeam's file anew, from the file alone: travel times and angles of its beams,\n"
      "attitude at transmission and reception, the mounting of both arrays, the sound speed at their face and below.\n"
      "Depths are below the water line. Exit codes: 0 done, 1 farther off than --within, 2 the file lacks something.",
      "ensonify georeference");
  Options options;
  declare(app, options);
  return tool_main(app, argc, argv, [&] { return georeference(options); });
}
