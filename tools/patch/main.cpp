// ensonify patch: the patch test of a multibeam echo sounder, from a record of its lines.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "components/errors/exit_error.h"
#include "components/runtime/tool.h"
#include "components/survey_files/survey.h"
#include "kernels/survey/boresight/adjust.h"
#include "tools/patch/file_soundings.h"
#include "tools/patch/record_soundings.h"
#include "tools/patch/split_lines.h"

namespace {

using namespace ensonify;
using namespace ensonify::patch_tool;
using frames::Vec3;

constexpr double kDegree = M_PI / 180.0;

/// Result of a patch test, and its input.
struct Finding {
  RecordInput input;           // its soundings have gone into `lines`
  std::vector<RunLine> lines;  // all that were found
  std::vector<bool> used;      // of the lines
  boresight::Adjusted adjusted;
};

/// How an unknown is written: in ms or degrees.
struct Writing {
  const char* name;
  const char* unit;
  double per_unit;
  const char* meaning;
};
constexpr Writing kWritings[boresight::kUnknowns] = {
    {"position latency", "ms", 1e-3, "positions are older than their stamps say"},
    {"attitude latency", "ms", 1e-3, "so are attitudes"},
    {"roll", "deg", kDegree, "add to the measured mounting; starboard down"},
    {"pitch", "deg", kDegree, "likewise; bow up"},
    {"yaw", "deg", kDegree, "likewise; clockwise from above"},
};

std::string line_text(const RunLine& line, std::size_t n, bool used) {
  return fmt::format("  {:>3} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.2f} {:>11}{}\n", n, line.from_s, line.to_s,
                     line.heading_rad / kDegree, line.speed_mps, line.line.soundings.size(), used ? "" : "  not used");
}

std::string as_text(const Finding& f) {
  const boresight::Adjusted& a = f.adjusted;
  std::string text =
      fmt::format("  {:>3} {:>9} {:>9} {:>9} {:>9} {:>11}\n", "line", "from s", "to s", "heading", "m/s", "soundings");
  for (std::size_t n = 0; n < f.lines.size(); ++n) text += line_text(f.lines[n], n + 1, f.used[n]);
  text += fmt::format(
      "{} soundings of {} in {} cells; about the cells' planes {:.3f} m before, {:.3f} m after, {} rounds{}\n",
      a.soundings, f.input.accepted, a.cells, a.rms_before_m, a.rms_after_m, a.rounds,
      a.converged ? "" : ", NOT CONVERGED");
  const boresight::Unknowns found = boresight::unknowns_of(a.offsets);
  for (std::size_t k = 0; k < boresight::kUnknowns; ++k) {
    const Writing& w = kWritings[k];
    const auto i = static_cast<Eigen::Index>(k);
    if (a.sd[i] == 0.0) continue;
    text += fmt::format("{:<17} {:>9.3f} +- {:.3f} {}  ({})\n", w.name, found[i] / w.per_unit,
                        a.half_95[i] / w.per_unit, w.unit, w.meaning);
  }
  return text;
}

std::string as_json(const Finding& f) {
  const boresight::Adjusted& a = f.adjusted;
  nlohmann::ordered_json json;
  const boresight::Unknowns found = boresight::unknowns_of(a.offsets);
  for (std::size_t k = 0; k < boresight::kUnknowns; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    if (a.sd[i] == 0.0) continue;
    const std::string key = std::string(boresight::kUnknownNames[k]) + (k < 2 ? "_s" : "_rad");
    json[key] = {{"value", found[i]}, {"half_interval_95", a.half_95[i]}};
  }
  json["lines"] = nlohmann::ordered_json::array();
  for (std::size_t n = 0; n < f.lines.size(); ++n) {
    const RunLine& line = f.lines[n];
    json["lines"].push_back({{"from_s", line.from_s},
                             {"to_s", line.to_s},
                             {"heading_rad", line.heading_rad},
                             {"speed_mps", line.speed_mps},
                             {"soundings", line.line.soundings.size()},
                             {"used", bool(f.used[n])}});
  }
  json["soundings"] = a.soundings;
  json["cells"] = a.cells;
  json["rms_before_m"] = a.rms_before_m;
  json["rms_after_m"] = a.rms_after_m;
  json["rounds"] = a.rounds;
  json["converged"] = a.converged;
  json["soundings_topic"] = f.input.soundings_topic;
  json["estimate_topic"] = f.input.estimate_topic;
  return json.dump(2) + "\n";
}

struct Options {
  std::vector<std::string> files;
  Reading reading;
  std::vector<std::size_t> lines;
  std::vector<std::string> solve;
  boresight::AdjustSettings settings;
  double position_sd_m = 0.05, height_sd_m = 0.05, level_sd_deg = 0.02, heading_sd_deg = 0.05;
  double angle_sd_deg = 0.004;
  bool json = false;
};

void add_options(CLI::App& app, Options& o) {
  app.add_option("FILE", o.files, "a record with soundings/1 and estimate/1 of the lines, or .kmall and .all files")
      ->required();
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

RecordInput read(const Options& o) {
  if (!survey_files::is_survey_file(o.files[0])) {
    if (o.files.size() > 1)
      throw UserError(o.files[1] + ": one record at a time; several may be .kmall and .all files");
    return read_soundings(o.files[0], o.reading);
  }
  if (!o.reading.soundings.empty() || !o.reading.estimate.empty())
    throw UserError(o.files[0] + ": has no topics; --soundings and --estimate are for records");
  return read_files(o.files, o.reading.most);
}

int patch(Options& o) {
  choose_unknowns(o);
  o.settings.angle_sd_rad = o.angle_sd_deg * kDegree;
  Finding finding;
  finding.input = read(o);
  finding.lines = split_lines(finding.input.soundings);
  finding.used = used_lines(o, finding.lines.size());
  std::vector<boresight::Line> lines;
  for (std::size_t n = 0; n < finding.lines.size(); ++n) {
    if (finding.used[n]) lines.push_back(with_deviations(finding.lines[n], finding.input, o));
  }
  try {
    finding.adjusted = boresight::adjust(lines, o.settings);
  } catch (const std::invalid_argument& error) {
    throw UserError(fmt::format("{}: {} straight lines of 20 s or more, {} used: {}", o.files[0], finding.lines.size(),
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
