#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

#include "components/errors/exit_error.h"
#include "tools/plan/line_files.h"

namespace ensonify::plan {
namespace {

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// Three capitals, or digits: what records of Hypack begin with.
bool is_keyword(const std::string& word) {
  return word.size() == 3 &&
         std::all_of(word.begin(), word.end(), [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); });
}

/// Takes a file record by record. A line's places are counted where it ends: at EOL, at the next LIN or with the file.
class LnwReader {
 public:
  explicit LnwReader(const std::string& path) : path_(path) {}

  LineSet read() {
    std::ifstream file(path_);
    std::string text;
    for (int n = 1; std::getline(file, text); ++n) {
      words_ = words_of(text);
      if (words_.empty()) continue;
      place_ = fmt::format("{}:{}", path_, n);
      take(text);
    }
    end_line();
    if (lines_ && set_.lines.size() != *lines_) {
      throw UserError(fmt::format("{}: has {} lines, LNS says {}", path_, set_.lines.size(), *lines_));
    }
    return set_;
  }

 private:
  void take(const std::string& text) {
    const std::string& key = words_[0];
    if (!begun_) {
      begin_file(key);
    } else if (key == "LNS" && !lines_ && set_.lines.empty()) {
      lines_ = count();
    } else if (key == "LIN") {
      end_line();
      places_ = count();
      set_.lines.emplace_back();
    } else if (!places_) {
      throw UserError(fmt::format("{}: {} stands outside a line; allowed: LIN and the number of places", place_, key));
    } else if (key == "EOL") {
      end_line();
    } else if (key == "PTS") {
      if (words_.size() < 3) throw UserError(place_ + ": PTS without x and y");
      set_.lines.back().places.push_back({number_of(words_[1], place_), number_of(words_[2], place_)});
    } else if (key == "LNN") {
      const auto name = text.find_first_not_of(" \t", text.find("LNN") + 3);
      if (name != std::string::npos)
        set_.lines.back().name = text.substr(name, text.find_last_not_of(" \t\r") + 1 - name);
    } else if (!is_keyword(key)) {
      throw UserError(place_ + ": is no record; allowed: they begin with three capitals, as PTS, LNN and EOL do");
    } else if (set_.lines.back().places.size() < *places_) {
      throw UserError(
          fmt::format("{}: {} stands between the line's places; allowed: PTS, LIN says {} places and {} are here",
                      place_, key, *places_, set_.lines.back().places.size()));
    }  // else: the template of a cross-section, or the like
  }

  void begin_file(const std::string& key) {
    begun_ = true;
    if (key == "LNS") {
      lines_ = count();
    } else if (key != "LNW") {
      throw UserError(place_ + ": is no LNW file; allowed: it begins with LNS and the number of lines");
    }
  }

  void end_line() {
    if (places_ && set_.lines.back().places.size() != *places_) {
      throw UserError(
          fmt::format("{}: the line has {} places, LIN says {}", place_, set_.lines.back().places.size(), *places_));
    }
    places_.reset();
  }

  std::size_t count() const {
    if (words_.size() < 2) throw UserError(place_ + ": " + words_[0] + " says no number");
    const double value = number_of(words_[1], place_);
    if (value < 0.0 || value > 1e6 || value != std::floor(value)) {
      throw UserError(fmt::format("{}: {} {} is no count; allowed: 0 to 1000000", place_, words_[0], words_[1]));
    }
    return static_cast<std::size_t>(value);
  }

  const std::string& path_;
  std::string place_;  // of the record in hand
  std::vector<std::string> words_;
  LineSet set_;
  bool begun_ = false;
  std::optional<std::size_t> lines_;   // that LNS says
  std::optional<std::size_t> places_;  // that LIN says, within a line
};

}  // namespace

LineSet read_lnw(const std::string& path) { return LnwReader(path).read(); }

}  // namespace ensonify::plan
