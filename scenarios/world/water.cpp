#include "scenarios/world/water.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>

#include "components/config/config_error.h"
#include "components/config/config_node.h"
#include "components/config/read_parameters.h"
#include "scenarios/world/sections.h"

namespace ensonify {

namespace {

/// `cast: FILE`, or `cast: { path: FILE, depth_m: "Depth (m)", ... }` with what the columns are called.
std::vector<WaterSample> read_cast_of(ConfigReader& from) {
  std::string path;
  CastColumns columns;
  if (const ConfigNode* node = from.node("cast"); node->is_map()) {
    ConfigReader cast = from.section("cast");
    cast.required_path("path", path);
    read_parameters(cast, columns);
  } else {
    from.required_path("cast", path);
  }
  if (path.empty()) return {};
  try {
    return read_cast(path, columns);
  } catch (const ConfigError& error) {
    from.add(error);
    return {};
  }
}

std::vector<WaterSample> read_samples(ConfigReader& from) {
  std::vector<WaterSample> samples;
  for (auto& knot : from.list("profile")) {
    WaterSample sample;
    read_parameters(knot, sample);
    if (!knot.has("sound_speed_mps") && !(knot.has("temperature_degc") && knot.has("salinity_psu"))) {
      knot.problem("", "needs sound_speed_mps, or temperature_degc and salinity_psu");
    }
    if (!samples.empty() && knot.has("depth_m") && sample.depth_m <= samples.back().depth_m) {
      knot.problem("depth_m", "is not below the sample before; depths must rise");
    }
    samples.push_back(sample);
  }
  return samples;
}

/// One of sound_speed_mps, profile, cast.
WaterProfile read_profile(ConfigReader& from) {
  WaterProfile profile;
  read_parameters(from, profile);
  if (from.has("profile")) profile.samples = read_samples(from);
  if (from.has("cast")) {
    if (from.has("profile")) from.problem("cast", "stands beside profile; give one or the other");
    profile.samples = read_cast_of(from);
  }
  if (from.has("sound_speed_mps") && (from.has("profile") || from.has("cast"))) {
    from.problem("sound_speed_mps", "stands beside a profile or cast; give one or the other");
  }
  return profile;
}

/// One of the scattering layers as a file has it.
struct LayerInFile {
  std::array<double, 2> depths_m{};
  double sv_db = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("depth_m", "m", must(in(0, sample_limits::kDeepest_m)), "[top, bottom]", self.depths_m);
    visit("sv_db", "dB", must(in(-150, 0)), "volume scattering strength re 1/m", self.sv_db);
  }
  void check(const ConfigReader& from) const {
    if (from.has("depth_m") && from.good() && depths_m[0] >= depths_m[1]) {
      from.problem("depth_m", "is not [top, bottom] with the bottom below the top");
    }
  }
};

/// Warm and salt water at great depth may be beyond what a profile takes.
void check_speeds(const ConfigReader& from, const Water& water, const WaterProfile& profile) {
  using namespace sample_limits;
  for (const WaterSample& sample : profile.samples) {
    if (sample.sound_speed_mps || !sample.temperature_degc || !sample.salinity_psu) continue;
    const double speed_mps =
        water::sound_speed_mps(water.sound_speed_law, *sample.temperature_degc, *sample.salinity_psu, sample.depth_m);
    if (speed_mps < kSlowest_mps || speed_mps > kFastest_mps) {
      from.problem(from.has("cast") ? "cast" : "profile",
                   fmt::format("makes a sound speed of {:.1f} m/s at {} m; allowed: [{}, {}]", speed_mps,
                               sample.depth_m, kSlowest_mps, kFastest_mps));
    }
  }
}

ParameterList profile_list() {
  ParameterList list = parameters_of<WaterProfile>();
  list.push_back(list_info("profile", "samples; linear between them, constant beyond", parameters_of<WaterSample>()));
  ParameterList cast = parameters_of<CastColumns>();
  cast.insert(cast.begin(), file_info("path", "a text file with commas, semicolons or tabs between columns"));
  list.push_back(file_or_info("cast", "a measured profile: its file, or a map with what the columns are called", cast));
  return list;
}

constexpr std::size_t kMostProblems = 10;

struct Cell {
  std::string text;
  int column = 1;  // of its first character in the line
};

std::vector<Cell> cells_of(const std::string& line) {
  std::vector<Cell> cells;
  std::size_t start = 0;
  while (start <= line.size()) {
    const std::size_t end = std::min(line.find_first_of(",;\t", start), line.size());
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
      const std::vector<Cell> cells = cells_of(line);
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
  std::array<Quantity, 4> quantities_;
  std::vector<WaterSample> samples_;
  std::vector<ConfigProblem> problems_;
};

}  // namespace

ParameterList water_list() {
  ParameterList list = parameters_of<Water>();
  for (ParameterInfo& info : profile_list()) list.push_back(std::move(info));
  list.push_back(
      section_info("applied", "the profile that soundings are corrected with; left out: the true one", profile_list()));
  list.push_back(
      list_info("scattering_layers", "layers that scatter sound in the water", parameters_of<LayerInFile>()));
  return list;
}

Water read_water(ConfigReader from) {
  Water water;
  read_parameters(from, water);
  water.profile = read_profile(from);
  check_speeds(from, water, water.profile);
  if (auto applied = from.optional_section("applied")) {
    water.applied = read_profile(*applied);
    check_speeds(*applied, water, water.applied);
    if (!applied->has("sound_speed_mps") && !applied->has("profile") && !applied->has("cast")) {
      from.problem("applied", "needs sound_speed_mps, profile or cast");
    }
  }
  for (auto& item : from.list("scattering_layers")) {
    LayerInFile layer;
    read_parameters(item, layer);
    water.scattering_layers.push_back({layer.depths_m[0], layer.depths_m[1], layer.sv_db});
  }
  return water;
}

std::vector<WaterSample> read_cast(const std::string& path, const CastColumns& columns) {
  return CastReader(path, columns).read();
}

}  // namespace ensonify
