#include "scenarios/world/cast.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>

#include "components/config/config_error.h"
#include "components/config/config_node.h"
#include "components/config/scalar_text.h"

namespace ensonify {

namespace {

constexpr std::size_t kMostProblems = 10;

struct Cell {
  std::string text;
  int column = 1;  // of its first character in the line
};

constexpr const char* kMarks = ",;\t";

/// Cells between blanks, any number of them.
std::vector<Cell> words_of(const std::string& line) {
  std::vector<Cell> cells;
  std::size_t end = 0;
  for (std::size_t start = 0; (start = line.find_first_not_of(" \r", end)) != std::string::npos;) {
    end = std::min(line.find_first_of(" \r", start), line.size());
    cells.push_back({line.substr(start, end - start), static_cast<int>(start) + 1});
  }
  return cells;
}

std::vector<Cell> cells_of(const std::string& line) {
  std::vector<Cell> cells;
  std::size_t start = 0;
  while (start <= line.size()) {
    const std::size_t end = std::min(line.find_first_of(kMarks, start), line.size());
    const std::size_t first = std::min(line.find_first_not_of(" \"", start), end);
    const std::size_t last = line.find_last_not_of(" \"\r", end - (end > 0 ? 1 : 0));
    const bool blank = first == end || last == std::string::npos || last < first;
    cells.push_back({blank ? "" : line.substr(first, last + 1 - first), static_cast<int>(first) + 1});
    start = end + 1;
  }
  return cells;
}

/// One of the four quantities of a sample, and where its column is.
struct Quantity {
  const char* name;
  const std::string& stated;
  double lo, hi;
  std::optional<std::size_t> index;
};

class CastReader {
 public:
  CastReader(std::string path, const CastColumns& stated)
      : path_(std::move(path)),
        all_by_default_(stated == CastColumns{}),
        quantities_{
            {{"depth_m", stated.depth_m, 0, sample_limits::kDeepest_m, {}},
             {"sound_speed_mps", stated.sound_speed_mps, sample_limits::kSlowest_mps, sample_limits::kFastest_mps, {}},
             {"temperature_degc",
              stated.temperature_degc,
              sample_limits::kColdest_degc,
              sample_limits::kWarmest_degc,
              {}},
             {"salinity_psu", stated.salinity_psu, 0, sample_limits::kSaltiest_psu, {}}}} {}

  std::vector<WaterSample> read() {
    std::ifstream in(path_);
    if (!in) problem(0, 0, "", "cannot be read");
    std::string line;
    bool first = true;
    for (int number = 1; problems_.size() < kMostProblems && std::getline(in, line); ++number) {
      const std::size_t start = line.find_first_not_of(" \t\r");
      if (start == std::string::npos || line[start] == '#' || line[start] == '%') continue;
      if (first) blanks_ = line.find_first_of(kMarks) == std::string::npos;
      const std::vector<Cell> cells = blanks_ ? words_of(line) : cells_of(line);
      if (!first || !find_columns(cells, number)) add_sample(cells, number);
      first = false;
    }
    if (problems_.empty() && samples_.empty()) problem(0, 0, "", "holds no sample");
    if (!problems_.empty()) throw ConfigError(std::move(problems_));
    return std::move(samples_);
  }

 private:
  /// Whether the first line names the columns. It must, unless all that are stated are numbers.
  bool find_columns(const std::vector<Cell>& cells, int line) {
    const auto is_number = [](const Cell& cell) { return parse_number(cell.text).has_value(); };
    if (all_by_default_ && cells.size() == 2 && std::all_of(cells.begin(), cells.end(), is_number)) {
      quantities_[0].index = 0;
      quantities_[1].index = 1;
      return false;
    }
    bool names = false;
    for (Quantity& quantity : quantities_) {
      if (const auto number = parse_natural(quantity.stated); number && *number >= 1) {
        quantity.index = *number - 1;
        continue;
      }
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells[i].text == quantity.stated) quantity.index = i;
      }
      names = names || quantity.index || quantity.stated != quantity.name;
      if (!quantity.index && quantity.stated != quantity.name) {
        problem(line, 1, quantity.name, "there is no column named \"" + quantity.stated + "\"");
      }
    }
    const auto& [depth, speed, temperature, salinity] = quantities_;
    if (problems_.empty() && !(depth.index && (speed.index || (temperature.index && salinity.index)))) {
      problem(line, 1, "",
              "needs columns for depth_m and sound_speed_mps, or depth_m, temperature_degc and "
              "salinity_psu; state what they are called or their numbers");
    }
    return names || !problems_.empty();
  }

  void add_sample(const std::vector<Cell>& cells, int line) {
    if (!problems_.empty() && samples_.empty()) return;  // its columns are not known
    std::array<std::optional<double>, 4> values;
    for (std::size_t i = 0; i < quantities_.size(); ++i) {
      if (quantities_[i].index && !read_value(quantities_[i], cells, line, values[i])) return;
    }
    if (!samples_.empty() && *values[0] <= samples_.back().depth_m) {
      return problem(line, cells[*quantities_[0].index].column, "depth_m",
                     fmt::format("{} is not below the {} of the sample before", *values[0], samples_.back().depth_m));
    }
    samples_.push_back({*values[0], values[1], values[2], values[3]});
  }

  bool read_value(const Quantity& quantity, const std::vector<Cell>& cells, int line, std::optional<double>& value) {
    if (*quantity.index >= cells.size()) {
      problem(line, 1, quantity.name, fmt::format("has no column {}", *quantity.index + 1));
      return false;
    }
    const Cell& cell = cells[*quantity.index];
    value = parse_number(cell.text);
    if (value && *value >= quantity.lo && *value <= quantity.hi) return true;
    problem(line, cell.column, quantity.name,
            fmt::format("is \"{}\", not a number in [{}, {}]", cell.text, quantity.lo, quantity.hi));
    return false;
  }

  void problem(int line, int column, const std::string& key, const std::string& message) {
    problems_.push_back({{path_, line, column}, key, message});
  }

  std::string path_;
  bool all_by_default_;
  bool blanks_ = false;  // between columns
  std::array<Quantity, 4> quantities_;
  std::vector<WaterSample> samples_;
  std::vector<ConfigProblem> problems_;
};

}  // namespace

std::vector<WaterSample> read_cast(const std::string& path, const CastColumns& columns) {
  return CastReader(path, columns).read();
}

}  // namespace ensonify
