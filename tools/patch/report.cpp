#include "tools/patch/report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace ensonify::patch_tool {

namespace {

constexpr double kDegree = M_PI / 180.0;

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

}  // namespace

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

}  // namespace ensonify::patch_tool
