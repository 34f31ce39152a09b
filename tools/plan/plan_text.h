#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ensonify::plan {

/// Lines as people exchange them.
struct LineSet {
  struct Line {
    std::string name;  // may be empty
    std::vector<std::array<double, 2>> places;
  };
  bool geodetic = false;  // places are [latitude, longitude] in degrees, WGS 84; else [east, north] in world metres
  std::vector<Line> lines;
};

/// A number of a plan with its unit in its name.
using Numbers = std::vector<std::pair<std::string, double>>;

/// Format of a printed plan.
enum class Format { kYaml, kJson, kCsv };

/// The lines as a mission (yaml, mission/1, with the numbers as comments), as JSON with the numbers beside them, or as
/// CSV, one place a row (line,name,east_m,north_m or line,name,latitude_deg,longitude_deg), which import reads again.
std::string plan_text(const LineSet& set, const Numbers& numbers, std::optional<double> speed_mps, Format format);

/// Numbers alone: "name: value" lines, a JSON object, or CSV of two rows.
std::string numbers_text(const Numbers& numbers, Format format);

}  // namespace ensonify::plan
