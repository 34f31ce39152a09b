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
#include "scenarios/world/sections.h"
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

struct MeanLevel {
  double mean_m = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("mean_m", "m", in(-kHighest_m, kHighest_m), "mean level above chart datum", self.mean_m);
  }
};

struct ConstituentInFile {
  double amplitude_m = 0.0, phase_rad = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("amplitude_m", "m", must(in(0, kHighest_m)), "with the nodal factor of the year", self.amplitude_m);
    visit("phase_deg", "deg", in(-360, 360), "how far high water comes after reference_utc", self.phase_rad);
  }
};

struct TideInFile {
  double constant_m = 0.0;
  std::string gauge;

  static void parameters(auto& self, auto&& visit) {
    visit("constant_m", "m", computed(in(-kHighest_m, kHighest_m)), "the same level always, above chart datum",
          self.constant_m);
    visit("gauge", "", computed(path()), "readings of a gauge: lines \"2025-06-01T12:00:00Z,1.35\"", self.gauge);
  }
};

struct DatumsInFile {
  struct Apart {
    double constant_m = 0.0;
    std::string grid;
  };
  Apart geoid, datum;

  static void parameters(auto& self, auto&& visit) {
    const Allowed range = in(-kFarthestApart_m, kFarthestApart_m);
    visit("geoid_above_ellipsoid_m", "m", range, "the same everywhere", self.geoid.constant_m);
    visit("geoid_above_ellipsoid_grid", "", computed(path()), "or an Esri ASCII grid in metres of the world",
          self.geoid.grid);
    visit("datum_above_geoid_m", "m", range, "chart datum, the same everywhere", self.datum.constant_m);
    visit("datum_above_geoid_grid", "", computed(path()), "or an Esri ASCII grid in metres of the world",
          self.datum.grid);
  }
};

vertical::HarmonicTide read_harmonic(ConfigReader& from, double start_unix_s) {
  vertical::HarmonicTide tide;
  MeanLevel mean;
  read_parameters(from, mean);
  tide.mean_m = mean.mean_m;
  for (auto& item : from.list("constituents")) {
    ConstituentInFile constituent;
    const double speed_radps = read_constituent_radps(item);
    read_parameters(item, constituent);
    tide.constituents.push_back({speed_radps, constituent.amplitude_m,
                                 phase_at_start_rad(item, constituent.phase_rad, speed_radps, start_unix_s)});
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
  TideInFile tide;
  read_parameters(from, tide);
  if (tide.gauge.empty()) return vertical::Tide(tide.constant_m);
  try {
    return vertical::Tide(read_gauge(tide.gauge, start_unix_s));
  } catch (const ConfigError& error) {
    from.add(error);
    return {};
  }
}

bool has_digit(std::string_view text) { return text.find_first_of("0123456789") != std::string_view::npos; }

/// A number of metres, or the path of a grid.
vertical::Separation separation_of(const ConfigReader& from, const DatumsInFile::Apart& apart, const char* metres,
                                   const char* grid) {
  if (apart.grid.empty()) return vertical::Separation(apart.constant_m);
  if (from.has(metres)) from.problem(grid, std::string("stands beside ") + metres + "; give one or the other");
  try {
    return read_separation(apart.grid);
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

ParameterList vertical_list() {
  ParameterList constituent = constituent_list();
  constituent.push_back(parameters_of<ConstituentInFile>().front());
  ParameterList tide = parameters_of<TideInFile>();
  tide.push_back(parameters_of<MeanLevel>().front());
  tide.push_back(list_info("constituents", "harmonic constituents about the mean level", constituent));
  ParameterList list = parameters_of<DatumsInFile>();
  list.insert(list.begin(), section_info("tide", "one of constant_m, constituents, gauge", tide));
  return list;
}

Vertical read_vertical(ConfigReader from, double start_unix_s) {
  Vertical result;
  if (const auto tide = from.optional_section("tide")) result.tide = read_tide(*tide, start_unix_s);
  DatumsInFile datums;
  read_parameters(from, datums);
  result.datums.geoid_above_ellipsoid =
      separation_of(from, datums.geoid, "geoid_above_ellipsoid_m", "geoid_above_ellipsoid_grid");
  result.datums.datum_above_geoid = separation_of(from, datums.datum, "datum_above_geoid_m", "datum_above_geoid_grid");
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
