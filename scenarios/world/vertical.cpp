#include <fmt/format.h>

#include <cctype>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "components/config/config_node.h"
#include "components/config/read_parameters.h"
#include "components/config/scalar_text.h"
#include "scenarios/world/vertical_keys.h"

namespace ensonify {
namespace {

constexpr double kLongestGap_h = 6.0;  // of a gauge: readings farther apart miss high or low water

[[noreturn]] void refuse(const std::string& path, int line, const std::string& message) {
  throw ConfigError({{{path, line, line > 0 ? 1 : 0}, "", message}});
}

std::ifstream opened(const std::string& path) {
  std::ifstream in(path);
  if (!in) refuse(path, 0, "cannot be read");
  return in;
}

bool has_digit(std::string_view text) { return text.find_first_of("0123456789") != std::string_view::npos; }

vertical::Tide tide_of(const ConstantTide& tide, double) { return vertical::Tide(tide.constant_m); }
vertical::Tide tide_of(const GaugeTide& tide, double start_unix_s) {
  if (tide.gauge.empty()) return {};
  return vertical::Tide(read_gauge(tide.gauge, start_unix_s));
}
vertical::Tide tide_of(const HarmonicTideKeys& keys, double start_unix_s) {
  vertical::HarmonicTide tide;
  tide.mean_m = keys.mean_m;
  for (const TideConstituentKeys& constituent : keys.constituents) {
    tide.constituents.push_back(
        {constituent.speed_radps(), constituent.amplitude_m, constituent.phase_at_start_rad(start_unix_s)});
  }
  return vertical::Tide(tide);
}

vertical::Separation separation_of(const NotApart&) { return {}; }
vertical::Separation separation_of(const GeoidConstant& geoid) { return vertical::Separation(geoid.metres); }
vertical::Separation separation_of(const DatumConstant& datum) { return vertical::Separation(datum.metres); }
vertical::Separation separation_of(const auto& grid) {
  return grid.file.empty() ? vertical::Separation() : read_separation(grid.file);
}

/// What is wrong with a file goes to `from`.
template <class T>
T value_of(const ConfigReader& from, const auto& forms, const auto& convert) {
  try {
    return std::visit(convert, forms);
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

void TideKeys::check(const ConfigReader& from) const {
  const int kinds = int{from.has("constant_m")} + int{from.has("constituents")} + int{from.has("gauge")};
  if (kinds > 1) from.problem("", "says several things; give one of constant_m, constituents, gauge");
}

Vertical VerticalKeys::vertical(const ConfigReader& from, double start_unix_s) const {
  Vertical result;
  if (tide) {
    result.tide =
        value_of<vertical::Tide>(from, tide->form, [&](const auto& form) { return tide_of(form, start_unix_s); });
  }
  const auto separation = [](const auto& form) { return separation_of(form); };
  result.datums.geoid_above_ellipsoid = value_of<vertical::Separation>(from, geoid, separation);
  result.datums.datum_above_geoid = value_of<vertical::Separation>(from, datum, separation);
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
    if (!height_m || !(std::abs(*height_m) <= kHighestTide_m)) {  // nan is a number of YAML's
      refuse(path, number, fmt::format("has no height in [{}, {}] m after its time", -kHighestTide_m, kHighestTide_m));
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
