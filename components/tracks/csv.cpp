#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>

#include "components/config/scalar_text.h"
#include "components/errors/nearest_name.h"
#include "components/tracks/readers.h"
#include "scenarios/scenario_file.h"

namespace ensonify::tracks {
namespace {

enum class Column {
  kNone,
  kSeconds,
  kUtc,
  kLatitude,
  kLongitude,
  kEast,
  kNorth,
  kHeading,
  kRoll,
  kPitch,
  kHeave,
  kDepth,
  kHeight
};

struct Name {
  const char* name;
  Column column;
  double lo, hi;  // in the file's unit
};
constexpr double kFar = 1e7;
constexpr std::array kNames{
    Name{"time_s", Column::kSeconds, -1e12, 1e12},
    Name{"utc", Column::kUtc, 0, 0},
    Name{"timestamp", Column::kUtc, 0, 0},
    Name{"latitude_deg", Column::kLatitude, -90, 90},
    Name{"latitude", Column::kLatitude, -90, 90},
    Name{"longitude_deg", Column::kLongitude, -180, 180},
    Name{"longitude", Column::kLongitude, -180, 180},
    Name{"east_m", Column::kEast, -kFar, kFar},
    Name{"north_m", Column::kNorth, -kFar, kFar},
    Name{"heading_deg", Column::kHeading, -360, 360},
    Name{"roll_deg", Column::kRoll, -89, 89},
    Name{"pitch_deg", Column::kPitch, -89, 89},
    Name{"heave_m", Column::kHeave, -100, 100},
    Name{"depth_m", Column::kDepth, 0, 12000},
    Name{"height_m", Column::kHeight, -12000, 12000},
};
constexpr const char* kAllowed =
    "time_s or utc; latitude_deg and longitude_deg, or east_m and north_m; then any of heading_deg, roll_deg, "
    "pitch_deg, "
    "heave_m, depth_m, height_m";

std::string trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '"' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return std::string(text);
}

std::vector<std::string> cells_of(const std::string& line, char mark) {
  std::vector<std::string> cells;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t end = std::min(line.find(mark, start), line.size());
    cells.push_back(trimmed(std::string_view(line).substr(start, end - start)));
    start = end + 1;
  }
  return cells;
}

std::string small(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// UTC as "2025-06-01T12:00:00.5Z", or with a blank in the middle, or without the Z.
std::optional<std::int64_t> utc_ns(std::string text) {
  if (text.size() > 10 && text[10] == ' ') text[10] = 'T';
  if (!text.empty() && text.back() != 'Z') text += 'Z';
  return parse_utc_ns(text);
}

class CsvReader {
 public:
  explicit CsvReader(const std::string& file) : file_(file) { track_.file = file; }

  Track read() {
    std::ifstream in(file_);
    std::string line;
    for (number_ = 1; std::getline(in, line); ++number_) {
      const std::string text = trimmed(line);
      if (text.empty() || text.front() == '#') continue;
      if (columns_.empty()) read_names(line);
      else read_row(line);
    }
    if (columns_.empty()) throw UserError(file_ + ": is empty; allowed: a line of column names, and rows");
    return std::move(track_);
  }

 private:
  std::string here() const { return fmt::format("{}:{}", file_, number_); }

  void read_names(const std::string& line) {
    const std::size_t mark = line.find_first_of(",;\t");
    mark_ = mark == std::string::npos ? ',' : line[mark];
    std::vector<std::string> known;
    for (const Name& name : kNames) known.emplace_back(name.name);
    for (const std::string& cell : cells_of(line, mark_)) {
      const auto found = std::ranges::find(kNames, small(cell), [](const Name& one) { return std::string(one.name); });
      columns_.push_back(found == kNames.end() ? nullptr : &*found);
      const std::string near = found == kNames.end() ? nearest_name(small(cell), known) : "";
      if (!near.empty())
        throw UserError(fmt::format("{}: no column is named {}; did you mean {}?", here(), cell, near));
      if (columns_.back() != nullptr && has(columns_.back()->column, columns_.size() - 1))
        throw UserError(fmt::format("{}: {} gives what a column before it gives", here(), cell));
    }
    const bool timed = has(Column::kSeconds) != has(Column::kUtc);
    const bool geodetic = has(Column::kLatitude) && has(Column::kLongitude),
               metric = has(Column::kEast) && has(Column::kNorth);
    if (!timed || geodetic == metric || (has(Column::kDepth) && has(Column::kHeight)))
      throw UserError(
          fmt::format("{}: the columns give no track; allowed: {} (not both of these two)", here(), kAllowed));
  }

  bool has(Column column) const { return has(column, columns_.size()); }
  bool has(Column column, std::size_t before) const {
    return std::any_of(columns_.begin(), columns_.begin() + static_cast<std::ptrdiff_t>(before),
                       [&](const Name* one) { return one != nullptr && one->column == column; });
  }

  double number(const Name& name, const std::string& cell) const {
    const auto value = parse_number(cell);
    if (!value || !(*value >= name.lo && *value <= name.hi))
      throw UserError(fmt::format("{}: {} is {}; allowed: {:g} to {:g}", here(), name.name,
                                  cell.empty() ? "empty" : cell, name.lo, name.hi));
    return *value;
  }

  void read_row(const std::string& line) {
    const std::vector<std::string> cells = cells_of(line, mark_);
    if (cells.size() != columns_.size())
      throw UserError(
          fmt::format("{}: has {} cells; allowed: {}, as there are columns", here(), cells.size(), columns_.size()));
    std::int64_t ns = 0;
    frames::Geodetic place;
    frames::Vec2 spot(0, 0);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (columns_[i] == nullptr) continue;
      const Name& name = *columns_[i];
      if (name.column == Column::kUtc) {
        const auto utc = utc_ns(cells[i]);
        if (!utc)
          throw UserError(fmt::format("{}: {} is \"{}\"; allowed: UTC such as 2025-06-01T12:00:00.5Z", here(),
                                      name.name, cells[i]));
        ns = *utc;
      }
      if (name.column == Column::kSeconds) ns = std::llround(1e9 * number(name, cells[i]));
      if (name.column == Column::kLatitude) place.latitude_deg = number(name, cells[i]);
      if (name.column == Column::kLongitude) place.longitude_deg = number(name, cells[i]);
      if (name.column == Column::kEast) spot.x() = number(name, cells[i]);
      if (name.column == Column::kNorth) spot.y() = number(name, cells[i]);
    }
    if (has(Column::kEast)) append(track_.spots, {ns, spot}, here());
    else append(track_.fixes, {ns, place}, here());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (columns_[i] == nullptr || cells[i].empty()) continue;
      const auto take = [&](Column column, std::vector<Value>& to, double si) {
        if (columns_[i]->column == column) append(to, {ns, si * number(*columns_[i], cells[i])}, here());
      };
      take(Column::kHeading, track_.heading_rad, kDegree);
      take(Column::kRoll, track_.roll_rad, kDegree);
      take(Column::kPitch, track_.pitch_rad, kDegree);
      take(Column::kHeave, track_.heave_m, 1.0);
      take(Column::kDepth, track_.depth_m, 1.0);
      take(Column::kHeight, track_.height_m, 1.0);
    }
  }

  const std::string& file_;
  int number_ = 0;
  char mark_ = ',';
  std::vector<const Name*> columns_;  // nullptr: passed over
  Track track_;
};

}  // namespace

Track read_csv(const std::string& file) { return CsvReader(file).read(); }

}  // namespace ensonify::tracks
