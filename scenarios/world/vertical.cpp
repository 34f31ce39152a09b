#include "scenarios/world/vertical.h"

#include <fmt/format.h>

#include <cctype>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "components/config/config_reader.h"
#include "components/config/scalars.h"
#include "scenarios/world/motion.h"
#include "scenarios/world/world.h"

namespace ensonify {
namespace {

constexpr double kHighest_m = 20.0;         // of a tide
constexpr double kFarthestApart_m = 200.0;  // of two datums
constexpr double kLongestGap_h = 6.0;       // of a gauge: readings farther apart miss high or low water

[[noreturn]] void refuse(const std::string& path, int line, const std::string& message) {
  throw ConfigError({{{path, line, line > 0 ? 1 : 0}, "", message}});
}

std::ifstream opened(const std::string& path) {
  std::ifstream in(path);
  if (!in) refuse(path, 0, "cannot be read");
  return in;
}

vertical::HarmonicTide read_harmonic(ConfigReader& from, double start_unix_s) {
  vertical::HarmonicTide tide;
  from.optional("mean_m", tide.mean_m, -kHighest_m, kHighest_m);
  for (auto& item : from.list("constituents")) {
    vertical::Constituent constituent;
    constituent.speed_radps = read_constituent_radps(item);
    item.required("amplitude_m", constituent.amplitude_m, 0, kHighest_m);
    item.optional("phase_deg", constituent.phase_rad, -360, 360, kDegrees);
    constituent.phase_rad = phase_at_start_rad(item, constituent.phase_rad, constituent.speed_radps, start_unix_s);
    tide.constituents.push_back(constituent);
  }
  return tide;
}

vertical::Tide read_tide(ConfigReader from, double start_unix_s) {
  const int kinds = int{from.has("constant_m")} + int{from.has("constituents")} + int{from.has("gauge")};
  if (kinds != 1) {
    from.problem("", std::string(kinds == 0 ? "says nothing" : "says several things") +
                         "; give one of constant_m, constituents, gauge");
  }
  if (from.has("constituents")) return vertical::Tide(read_harmonic(from, start_unix_s));
  double constant_m = 0.0;
  from.optional("constant_m", constant_m, -kHighest_m, kHighest_m);
  std::string path;
  from.optional_path("gauge", path);
  if (path.empty()) return vertical::Tide(constant_m);
  try {
    return vertical::Tide(read_gauge(path, start_unix_s));
  } catch (const ConfigError& error) {
    from.add(error);
    return {};
  }
}

bool has_digit(std::string_view text) { return text.find_first_of("0123456789") != std::string_view::npos; }

/// A number of metres, or the path of a grid.
vertical::Separation read_separation_of(ConfigReader& from, const char* metres, const char* grid) {
  double constant_m = 0.0;
  std::string path;
  from.optional(metres, constant_m, -kFarthestApart_m, kFarthestApart_m);
  from.optional_path(grid, path);
  if (path.empty()) return vertical::Separation(constant_m);
  if (from.has(metres)) from.problem(grid, std::string("stands beside ") + metres + "; give one or the other");
  try {
    return read_separation(path);
  } catch (const ConfigError& error) {
    from.add(error);
    return {};
  }
}

/// What stands above the rows of an Esri ASCII grid.
struct EsriHead {
  std::size_t columns = 0, rows = 0;
  frames::Vec2 corner_enu_m;  // the south-west one, of the cells
  double cell_m = 0.0;
  std::optional<double> no_data;  // what cells without a value hold
  int lines = 5;
};

EsriHead read_esri_head(std::istream& in, const std::string& path) {
  EsriHead head;
  std::map<std::string, double> values{{"ncols", 0}, {"nrows", 0}, {"xllcorner", 0}, {"yllcorner", 0}, {"cellsize", 0}};
  std::string key;
  double value = 0.0;
  for (int line = 1; line <= head.lines; ++line) {
    if (!(in >> key >> value) || !values.contains(key)) {
      refuse(path, line, "is not one of ncols, nrows, xllcorner, yllcorner, cellsize with a number");
    }
    values[key] = value;
  }
  if (std::isalpha((in >> std::ws).peek()) != 0) {
    head.lines = 6;
    if (!(in >> key >> value) || key != "NODATA_value") {
      refuse(path, head.lines, "is neither NODATA_value with a number nor a row of values");
    }
    head.no_data = value;
  }
  if (!(values["ncols"] >= 2 && values["nrows"] >= 2 && values["ncols"] * values["nrows"] <= 1e7)) {
    refuse(path, 1, "has fewer than 2 x 2 or more than ten million cells");
  }
  head.columns = static_cast<std::size_t>(values["ncols"]);
  head.rows = static_cast<std::size_t>(values["nrows"]);
  head.corner_enu_m = {values["xllcorner"], values["yllcorner"]};
  head.cell_m = values["cellsize"];
  return head;
}

}  // namespace

Vertical read_vertical(ConfigReader from, double start_unix_s) {
  Vertical result;
  if (const auto tide = from.optional_section("tide")) result.tide = read_tide(*tide, start_unix_s);
  result.datums.geoid_above_ellipsoid =
      read_separation_of(from, "geoid_above_ellipsoid_m", "geoid_above_ellipsoid_grid");
  result.datums.datum_above_geoid = read_separation_of(from, "datum_above_geoid_m", "datum_above_geoid_grid");
  return result;
}

vertical::GaugeReadings read_gauge(const std::string& path, double start_unix_s) {
  std::ifstream in = opened(path);
  vertical::GaugeReadings readings;
  auto& read = readings.time_s_and_height_m;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    const std::size_t comma = std::min(line.find_first_of(",;\t"), line.size());
    const auto time_ns = parse_utc_ns(line.substr(0, comma));
    if (!time_ns && number == 1 && !has_digit(line.substr(0, comma))) continue;  // names of the columns
    if (!time_ns) refuse(path, number, "does not begin with a UTC time such as 2025-06-01T12:00:00Z");
    const auto height_m = parse_number(comma < line.size() ? line.substr(comma + 1) : "");
    if (!height_m || !(std::abs(*height_m) <= kHighest_m)) {  // nan is a number of YAML's
      refuse(path, number, fmt::format("has no height in [{}, {}] m after its time", -kHighest_m, kHighest_m));
    }
    const double time_s = static_cast<double>(*time_ns) * 1e-9 - start_unix_s;
    if (!read.empty() && time_s <= read.back().first) refuse(path, number, "is not later than the reading before");
    if (const double gap_h = read.empty() ? 0.0 : (time_s - read.back().first) / 3600.0;
        time_s > 0.0 && gap_h > kLongestGap_h) {
      refuse(
          path, number,
          fmt::format("is {:.1f} h after the reading before; allowed from the start of the run on: {} h, for readings "
                      "farther apart miss high or low water",
                      gap_h, kLongestGap_h));
    }
    read.emplace_back(time_s, *height_m);
  }
  if (read.empty()) refuse(path, 0, "holds no reading");
  return readings;
}

vertical::Separation read_separation(const std::string& path) {
  std::ifstream in = opened(path);
  const EsriHead head = read_esri_head(in, path);
  std::vector<double> values(head.columns * head.rows);
  for (std::size_t row = head.rows; row-- > 0;) {
    for (std::size_t column = 0; column < head.columns; ++column) {
      double& value = values[row * head.columns + column];
      if (!(in >> value) || std::abs(value) > kFarthestApart_m || value == head.no_data) {
        refuse(path, head.lines + static_cast<int>(head.rows - row),
               fmt::format("lacks a value in [{}, {}] m", -kFarthestApart_m, kFarthestApart_m));
      }
    }
  }
  const frames::Vec2 half_cell(0.5 * head.cell_m, 0.5 * head.cell_m);
  try {
    return {head.corner_enu_m + half_cell, head.cell_m, head.columns, head.rows, std::move(values)};
  } catch (const std::invalid_argument& error) {
    refuse(path, 1, error.what());
  }
}

}  // namespace ensonify
