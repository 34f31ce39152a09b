#include "tools/plan/csv.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "components/errors/exit_error.h"

namespace ensonify::plan {
namespace {

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

}  // namespace

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

std::string csv_cell(const std::string& text) {
  const bool blank_at_an_end = !text.empty() && (text.front() == ' ' || text.back() == ' ');
  if (!blank_at_an_end && text.find_first_of(",\"\r\n\t") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
  return cell + "\"";
}

}  // namespace ensonify::plan
