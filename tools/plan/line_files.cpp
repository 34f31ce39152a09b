#include "tools/plan/line_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "components/runtime/exit_error.h"

namespace ensonify::plan {
namespace {

constexpr double kShortest_m = 1.0;

double number_of(const std::string& text, const std::string& place) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    throw UserError(fmt::format("{}: \"{}\" is no number", place, text));
  }
  return value;
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

LineSet read_lnw(const std::string& path) {
  std::ifstream file(path);
  LineSet set;
  std::size_t promised = 0, places = 0;
  std::string text;
  for (int n = 1; std::getline(file, text); ++n) {
    const std::string place = fmt::format("{}:{}", path, n);
    const std::vector<std::string> words = words_of(text);
    if (words.empty()) continue;
    const auto count = [&] {
      if (words.size() < 2) throw UserError(place + ": " + words[0] + " says no number");
      const double value = number_of(words[1], place);
      if (value < 0.0 || value > 1e6 || value != std::floor(value)) {
        throw UserError(fmt::format("{}: {} {} is no count; allowed: 0 to 1000000", place, words[0], words[1]));
      }
      return static_cast<std::size_t>(value);
    };
    if (words[0] == "LNS") {
      promised = count();
    } else if (words[0] == "LIN") {
      places = count();
      set.lines.emplace_back();
    } else if (words[0] == "PTS") {
      if (set.lines.empty() || words.size() < 3) throw UserError(place + ": PTS without LIN or without x and y");
      set.lines.back().places.push_back({number_of(words[1], place), number_of(words[2], place)});
    } else if (words[0] == "LNN" && !set.lines.empty()) {
      const auto name = text.find_first_not_of(" \t", text.find("LNN") + 3);
      if (name != std::string::npos)
        set.lines.back().name = text.substr(name, text.find_last_not_of(" \t\r") + 1 - name);
    } else if (words[0] == "EOL") {
      if (!set.lines.empty() && set.lines.back().places.size() != places) {
        throw UserError(
            fmt::format("{}: the line has {} places, LIN says {}", place, set.lines.back().places.size(), places));
      }
    } else if (set.lines.empty() && promised == 0) {
      throw UserError(place + ": is no LNW file; allowed: it begins with LNS and the number of lines");
    }
  }
  if (set.lines.size() != promised) {
    throw UserError(fmt::format("{}: has {} lines, LNS says {}", path, set.lines.size(), promised));
  }
  return set;
}

LineSet read_csv(const std::string& path, bool projected) {
  std::ifstream file(path);
  std::string text;
  const auto cells_of = [](const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line.substr(0, line.find_last_not_of(" \t\r") + 1));
    for (std::string cell; std::getline(stream, cell, ',');) {
      const auto first = cell.find_first_not_of(" \t");
      cells.push_back(first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(" \t") + 1 - first));
    }
    return cells;
  };
  std::getline(file, text);
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);  // the byte order mark that spreadsheets write
  std::map<std::string, std::size_t> column;
  const std::vector<std::string> header = cells_of(text);
  for (std::size_t i = 0; i < header.size(); ++i) column[header[i]] = i;
  const bool geodetic = column.count("latitude_deg") != 0 && column.count("longitude_deg") != 0;
  const bool metres = column.count("east_m") != 0 && column.count("north_m") != 0;
  if (column.count("line") == 0 || geodetic == metres || (projected && geodetic)) {
    throw UserError(path + ":1: the header is \"" + text +
                    "\"; allowed: line, and either latitude_deg and longitude_deg or east_m and north_m" +
                    (projected ? " (the latter, with --crs)" : ""));
  }
  const std::size_t a = column[geodetic ? "latitude_deg" : "east_m"],
                    b = column[geodetic ? "longitude_deg" : "north_m"];
  LineSet set;
  set.geodetic = geodetic;
  std::string last;
  for (int n = 2; std::getline(file, text); ++n) {
    const std::string place = fmt::format("{}:{}", path, n);
    const std::vector<std::string> cells = cells_of(text);
    if (cells.empty()) continue;
    if (cells.size() <= std::max({a, b, column["line"]})) throw UserError(place + ": has too few columns");
    if (set.lines.empty() || cells[column["line"]] != last) set.lines.emplace_back();
    last = cells[column["line"]];
    if (column.count("name") != 0 && column["name"] < cells.size()) set.lines.back().name = cells[column["name"]];
    set.lines.back().places.push_back({number_of(cells[a], place), number_of(cells[b], place)});
  }
  return set;
}

/// What no vehicle can fly, told with the line's number.
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

LineSet read_lines(const std::string& path, const std::string& crs) {
  if (!std::ifstream(path)) throw UserError(path + ": cannot be read");
  std::string ending = std::filesystem::path(path).extension();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  LineSet set;
  if (ending == ".lnw") {
    set = read_lnw(path);
  } else if (ending == ".csv") {
    set = read_csv(path, !crs.empty());
  } else if (ending == ".geojson" || ending == ".json" || ending == ".kml" || ending == ".gpx") {
    set = read_vector_file(path);
  } else {
    throw UserError(path + ": has an ending that is not known; allowed: .lnw, .csv, .geojson, .json, .kml, .gpx");
  }
  if (!set.geodetic && !crs.empty()) set = geodetic_from(set, crs, path);
  check(set, path);
  return set;
}

}  // namespace ensonify::plan
