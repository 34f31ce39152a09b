#pragma once

#include <string>
#include <vector>

namespace ensonify::plan {

/// Comma-separated values as RFC 4180 has them: cells may stand in quotes, which are doubled inside, and then hold
/// commas and line ends. Blanks round a cell that is not quoted are left out, so are empty lines and the byte order
/// mark that spreadsheets write.
struct CsvRow {
  int line = 0;  // where it begins, from 1
  std::vector<std::string> cells;
};

/// Throws UserError with the line of a quote that is not closed or has text behind it.
std::vector<CsvRow> read_csv_rows(const std::string& path);

/// A text as one cell.
std::string csv_cell(const std::string& text);

}  // namespace ensonify::plan
