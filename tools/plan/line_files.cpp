#include "tools/plan/line_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "components/errors/exit_error.h"

namespace ensonify::plan {
namespace {

constexpr double kShortest_m = 1.0;

/// What no vehicle can run, reported with the line's number.
void check(const LineSet& set, const std::string& path) {
  if (set.lines.empty()) throw UserError(path + ": holds no lines");
  for (std::size_t i = 0; i < set.lines.size(); ++i) {
    const auto& places = set.lines[i].places;
    const std::string place = fmt::format("{}: line {}", path, i + 1);
    if (places.size() < 2) throw UserError(place + ": has fewer than 2 places");
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (!std::isfinite(places[k][0]) || !std::isfinite(places[k][1])) {
        throw UserError(fmt::format("{}: place {} is not of finite numbers", place, k + 1));
      }
      if (set.geodetic && (std::abs(places[k][0]) > 89.9 || std::abs(places[k][1]) > 180.0)) {
        throw UserError(fmt::format("{}: [{}, {}] is no latitude and longitude; allowed: up to 89.9 and 180 degrees{}",
                                    place, places[k][0], places[k][1],
                                    std::abs(places[k][1]) <= 89.9 ? "; are they swapped?" : ""));
      }
      if (k == 0) continue;
      const double m = set.geodetic ? 111e3 : 1.0;  // roughly: only what has no length is refused
      if (std::hypot(places[k][0] - places[k - 1][0], places[k][1] - places[k - 1][1]) * m < kShortest_m) {
        throw UserError(fmt::format("{}: place {} is less than 1 m from the one before", place, k + 1));
      }
    }
  }
}

}  // namespace

double number_of(const std::string& text, const std::string& place) {
  double value = 0.0;
  const char* begin = text.data() + (text.starts_with("+") && !text.starts_with("+-") ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    throw UserError(fmt::format("{}: \"{}\" is no number", place, text));
  }
  return value;
}

LineSet read_lines(const std::string& path, const std::string& crs) {
  if (!std::ifstream(path) || std::filesystem::is_directory(path)) throw UserError(path + ": cannot be read");
  std::string ending = std::filesystem::path(path).extension();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  LineSet set;
  if (ending == ".lnw") {
    set = read_lnw(path);
  } else if (ending == ".csv") {
    set = read_csv(path, !crs.empty());
  } else if (ending == ".geojson" || ending == ".json") {
    set = read_geojson(path);
  } else if (ending == ".kml") {
    set = read_kml(path);
  } else if (ending == ".gpx") {
    set = read_gpx(path);
  } else {
    throw UserError(path + ": has an ending that is not known; allowed: .lnw, .csv, .geojson, .json, .kml, .gpx");
  }
  if (!set.geodetic && !crs.empty()) set = geodetic_from(set, crs, path);
  check(set, path);
  return set;
}

}  // namespace ensonify::plan
