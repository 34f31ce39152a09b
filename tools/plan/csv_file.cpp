#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

#include "components/errors/exit_error.h"
#include "tools/plan/line_files.h"

namespace ensonify::plan {
namespace {

/// Comma-separated values as RFC 4180 has them: cells may stand in quotes, which are doubled inside, and then hold
/// commas and line ends. Blanks round a cell that is not quoted are left out, so are empty lines and the byte order
/// mark that spreadsheets write.
struct CsvRow {
  int line = 0;  // where it begins, from 1
  std::vector<std::string> cells;
};

/// Goes through a file's text, cell by cell.
class Csv {
 public:
  Csv(std::string text, const std::string& path) : text_(std::move(text)), path_(path) {
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;
  }

  bool at_end() const { return at_ >= text_.size(); }

  /// Up to the line end that closes it.
  CsvRow row() {
    CsvRow row{line_, {}};
    for (;;) {
      row.cells.push_back(cell());
      const bool more = !at_end() && text_[at_] == ',';
      if (!at_end()) step();
      if (!more) return row;
    }
  }

 private:
  /// Up to the comma or line end behind it.
  std::string cell() {
    skip_blanks();
    if (!at_end() && text_[at_] == '"') return quoted_cell();
    std::string cell;
    while (!at_end() && text_[at_] != ',' && text_[at_] != '\n') cell += step();
    return cell.substr(0, cell.find_last_not_of(" \t\r") + 1);
  }

  std::string quoted_cell() {
    const std::string place = fmt::format("{}:{}", path_, line_);
    std::string cell;
    for (step();; cell += step()) {
      if (at_end()) throw UserError(place + ": a quote is not closed");
      if (text_[at_] != '"') continue;
      step();
      if (at_end() || text_[at_] != '"') break;
    }
    skip_blanks();
    if (!at_end() && text_[at_] != ',' && text_[at_] != '\n') {
      throw UserError(place + ": text stands behind a quote; allowed: a comma or the line's end");
    }
    return cell;
  }

  void skip_blanks() {
    while (!at_end() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\r')) ++at_;
  }

  char step() {
    if (text_[at_] == '\n') ++line_;
    return text_[at_++];
  }

  std::string text_;
  const std::string& path_;
  std::size_t at_ = 0;
  int line_ = 1;
};

/// Throws UserError with the line of a quote that is not closed or has text behind it.
std::vector<CsvRow> read_csv_rows(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  Csv csv(std::string(std::istreambuf_iterator<char>(file), {}), path);
  std::vector<CsvRow> rows;
  while (!csv.at_end()) {
    CsvRow row = csv.row();
    if (row.cells != std::vector<std::string>{""}) rows.push_back(std::move(row));
  }
  return rows;
}

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
