// ensonify patch: the patch test of a multibeam echo sounder, from a record of its lines.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <optional>

#include "components/errors/exit_error.h"
#include "components/runtime/tool.h"
#include "tools/patch/report.h"

namespace {

using namespace ensonify;
using namespace ensonify::patch_tool;
using frames::Vec3;

constexpr double kDegree = M_PI / 180.0;

struct Options {
  std::string record;
  Reading reading;
  std::vector<std::size_t> lines;
  std::vector<std::string> solve;
  boresight::AdjustSettings settings;
  double position_sd_m = 0.05, height_sd_m = 0.05, level_sd_deg = 0.02, heading_sd_deg = 0.05;
  double angle_sd_deg = 0.004;
  bool json = false;
};

void add_options(CLI::App& app, Options& o) {
  app.add_option("RECORD", o.record, "a record with soundings/1 and estimate/1 of the lines")->required();
  app.add_option("--soundings", o.reading.soundings, "topic of the soundings (default: the only one)");
  app.add_option("--estimate", o.reading.estimate, "topic of the navigation estimate (default: the only one)");
  app.add_option("--lines", o.lines, "numbers of the lines to use, as printed (default: all)")->delimiter(',');
  app.add_option("--solve", o.solve,
                 "unknowns to solve for: position_latency, attitude_latency, roll, pitch, yaw (default: all)")
      ->delimiter(',');
  app.add_option("--cell", o.settings.cell_m, "side of the squares in which lines are compared, m")
      ->capture_default_str();
  app.add_option("--most", o.reading.most, "soundings to use at most; more are thinned evenly")->capture_default_str();
  app.add_option("--wander", o.settings.wander_s, "correlation time of the errors of positions, s")
      ->capture_default_str();
  app.add_option("--turn-wander", o.settings.turn_wander_s, "the same of attitudes, s")->capture_default_str();
  app.add_option("--together", o.settings.together_s, "stretch of time in which soundings may err together besides, s")
      ->capture_default_str();
  app.add_option("--position-sd", o.position_sd_m, "of positions, m, where the estimate states none")
      ->capture_default_str();
  app.add_option("--height-sd", o.height_sd_m, "of heights, tide and heave, m, likewise")->capture_default_str();
  app.add_option("--level-sd", o.level_sd_deg, "of roll and pitch, degrees, likewise")->capture_default_str();
  app.add_option("--heading-sd", o.heading_sd_deg, "of headings, degrees, likewise")->capture_default_str();
  app.add_option("--angle-sd", o.angle_sd_deg, "by which all angles across may be off together, degrees: as roll does")
      ->capture_default_str();
  app.add_option("--layings", o.settings.layings, "of the squares, each way; the answer is the mean of all")
      ->capture_default_str();
  app.add_flag("--json", o.json, "print JSON, in s and rad");
}

void choose_unknowns(Options& o) {
  if (o.solve.empty()) return;
  o.settings.solve.fill(false);
  for (const std::string& name : o.solve) {
    const auto* at = std::find(boresight::kUnknownNames.begin(), boresight::kUnknownNames.end(), name);
    if (at == boresight::kUnknownNames.end()) {
      throw UserError(
          fmt::format("--solve {}: position_latency, attitude_latency, roll, pitch and yaw can be solved for", name));
    }
    o.settings.solve[static_cast<std::size_t>(at - boresight::kUnknownNames.begin())] = true;
  }
}

std::vector<bool> used_lines(const Options& o, std::size_t there) {
  std::vector<bool> used(there, o.lines.empty());
  for (const std::size_t n : o.lines) {
    if (n < 1 || n > there) throw UserError(fmt::format("--lines {}: the record has lines 1 to {}", n, there));
    used[n - 1] = true;
  }
  return used;
}

/// The line with what the estimate states of its own errors meanwhile, or where it does not, the options.
boresight::Line with_deviations(const RunLine& run, const RecordInput& input, const Options& o) {
  boresight::Line line = run.line;
  const Stated stated = mean_stated(input.stated, run.from_s, run.to_s);
  const bool reported = !stated.position_variance_m2.isZero(0.0) && !stated.rotation_variance_rad2.isZero(0.0);
  line.position_sd_m =
      reported ? Vec3(stated.position_variance_m2.cwiseSqrt()) : Vec3(o.position_sd_m, o.position_sd_m, o.height_sd_m);
  line.rotation_sd_rad = reported ? Vec3(stated.rotation_variance_rad2.cwiseSqrt())
                                  : Vec3(kDegree * Vec3(o.level_sd_deg, o.level_sd_deg, o.heading_sd_deg));
  return line;
}

int patch(Options& o) {
  choose_unknowns(o);
  o.settings.angle_sd_rad = o.angle_sd_deg * kDegree;
  Finding finding;
  finding.input = read_soundings(o.record, o.reading);
  finding.lines = split_lines(finding.input.soundings);
  finding.used = used_lines(o, finding.lines.size());
  std::vector<boresight::Line> lines;
  for (std::size_t n = 0; n < finding.lines.size(); ++n) {
    if (finding.used[n]) lines.push_back(with_deviations(finding.lines[n], finding.input, o));
  }
  try {
    finding.adjusted = boresight::adjust(lines, o.settings);
  } catch (const std::invalid_argument& error) {
    throw UserError(fmt::format("{}: {} straight lines of 20 s or more, {} used: {}", o.record, finding.lines.size(),
                                lines.size(), error.what()));
  }
  fmt::print("{}", o.json ? as_json(finding) : as_text(finding));
  return kExitOk;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Patch test: from soundings of the same seabed on several lines, how the echo sounder is turned on its vehicle "
      "and how\n"
      "late its navigation is (docs/manual/patch-test.md). Sees what instruments said, never the truth.\n"
      "Exit code: 0 done, 2 the record cannot be read or its lines cannot be compared.",
      "ensonify patch");
  Options options;
  add_options(app, options);
  return tool_main(app, argc, argv, [&] { return patch(options); });
}
