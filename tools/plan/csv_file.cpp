#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "components/errors/exit_error.h"
#include "tools/plan/csv.h"
#include "tools/plan/readers.h"

namespace ensonify::plan {
namespace {

const std::vector<std::string> kColumns = {"line", "name", "latitude_deg", "longitude_deg", "east_m", "north_m"};

/// Where each column that we know stands.
std::map<std::string, std::size_t> columns_of(const CsvRow& header, const std::string& path) {
  std::map<std::string, std::size_t> columns;
  for (std::size_t i = 0; i < header.cells.size(); ++i) {
    const std::string& name = header.cells[i];
    if (std::find(kColumns.begin(), kColumns.end(), name) == kColumns.end()) continue;
    if (!columns.emplace(name, i).second) {
      throw UserError(fmt::format("{}:{}: has the column {} twice", path, header.line, name));
    }
  }
  return columns;
}

std::string joined(const std::vector<std::string>& cells) {
  std::string text;
  for (const auto& cell : cells) text += (text.empty() ? "" : ",") + cell;
  return text;
}

/// More cells than the header names are no columns: 1,465000,00 is a number with a decimal comma.
void check_width(const CsvRow& row, std::size_t least, std::size_t header, const std::string& place) {
  if (row.cells.size() < least) throw UserError(place + ": has too few columns");
  const auto last = std::find_if(row.cells.rbegin(), row.cells.rend(), [](const auto& cell) { return !cell.empty(); });
  const auto filled = static_cast<std::size_t>(row.cells.rend() - last);
  if (filled > header) throw UserError(fmt::format("{}: has {} columns, the header {}", place, filled, header));
}

}  // namespace

LineSet read_csv(const std::string& path, bool projected) {
  std::vector<CsvRow> rows = read_csv_rows(path);
  if (rows.empty()) rows.push_back({1, {}});
  const CsvRow& header = rows[0];
  auto column = columns_of(header, path);
  const bool geodetic = column.count("latitude_deg") != 0 && column.count("longitude_deg") != 0;
  const bool metres = column.count("east_m") != 0 && column.count("north_m") != 0;
  if (column.count("line") == 0 || geodetic == metres || (projected && geodetic)) {
    throw UserError(fmt::format(
        "{}:{}: the header is \"{}\"; allowed: line, and either latitude_deg and longitude_deg or east_m and north_m{}",
        path, header.line, joined(header.cells), projected ? " (the latter, with --crs)" : ""));
  }
  const std::size_t line = column["line"], a = column[geodetic ? "latitude_deg" : "east_m"],
                    b = column[geodetic ? "longitude_deg" : "north_m"];
  LineSet set;
  set.geodetic = geodetic;
  std::string last;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto& cells = rows[i].cells;
    const std::string place = fmt::format("{}:{}", path, rows[i].line);
    check_width(rows[i], std::max({a, b, line}) + 1, header.cells.size(), place);
    if (set.lines.empty() || cells[line] != last) set.lines.emplace_back();
    last = cells[line];
    if (column.count("name") != 0 && column["name"] < cells.size()) set.lines.back().name = cells[column["name"]];
    set.lines.back().places.push_back({number_of(cells[a], place), number_of(cells[b], place)});
  }
  return set;
}

}  // namespace ensonify::plan
