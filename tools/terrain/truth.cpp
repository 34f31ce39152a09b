#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "components/errors/exit_error.h"
#include "kernels/seabed/statistics/power_spectrum.h"
#include "kernels/seabed/statistics/surface.h"
#include "tools/terrain/verbs.h"

namespace ensonify::terrain_tool {
namespace {

using nlohmann::ordered_json;
using relief_statistics::Surface;

struct Options {
  std::string seabed;
  std::vector<std::string> windows;
};

/// A square of posts by its south-west corner.
struct Square {
  std::string name;
  double east_m = 0.0, north_m = 0.0, spacing_m = 0.0;
  int posts = 1024;
};

/// NAME=EAST,NORTH[,SPACING[,POSTS]]
Square square_of(const std::string& text, double own_spacing_m) {
  Square square;
  square.spacing_m = own_spacing_m;
  const auto equals = text.find('=');
  std::array<double, 4> number{0.0, 0.0, own_spacing_m, 1024.0};
  std::size_t count = 0;
  if (equals != std::string::npos) {
    square.name = text.substr(0, equals);
    std::istringstream stream(text.substr(equals + 1));
    char comma = ',';
    while (count < 4 && comma == ',' && stream >> number[count]) {
      ++count;
      if (!(stream >> comma)) comma = 0;
    }
    if (!stream.eof()) count = 0;
  }
  if (square.name.empty() || count < 2 || !(number[2] > 0.0) || number[3] < 256 || number[3] > 4096) {
    throw UserError("--window " + text +
                    ": is not NAME=EAST,NORTH[,SPACING[,POSTS]], in m from the origin, with 256 to 4096 posts");
  }
  square.east_m = number[0];
  square.north_m = number[1];
  square.spacing_m = number[2];
  square.posts = static_cast<int>(number[3]);
  return square;
}

double rounded(double value) { return std::isfinite(value) ? std::stod(fmt::format("{:.4g}", value)) : 0.0; }

/// rms about the plane in squares of 8, 16, 32 ... posts: over all of them, and their median.
ordered_json roughness_of(const Surface& z) {
  ordered_json rows = ordered_json::array();
  relief_statistics::Patch patch;
  for (int cells = 8; cells <= z.columns / 4; cells *= 2) {
    std::vector<double> rms_m;
    double squares = 0.0;
    for (int row = 0; row + cells <= z.rows; row += cells) {
      for (int column = 0; column + cells <= z.columns; column += cells) {
        if (!patch_of(z, column, row, cells, patch)) continue;
        double sum = 0.0;
        for (const double r : patch.residual_m) sum += r * r;
        squares += sum / (cells * cells);
        rms_m.push_back(std::sqrt(sum / (cells * cells)));
      }
    }
    if (rms_m.empty()) continue;
    std::sort(rms_m.begin(), rms_m.end());
    rows.push_back({{"side_m", cells * z.spacing_m},
                    {"rms_m", rounded(std::sqrt(squares / static_cast<double>(rms_m.size())))},
                    {"median_m", rounded(relief_statistics::percentile(rms_m, 0.5))}});
  }
  return rows;
}

/// Percentiles of the slope between neighbouring posts, degrees.
ordered_json slopes_of(const Surface& z) {
  std::vector<double> slope_deg;
  for (int row = 0; row + 1 < z.rows; ++row) {
    for (int column = 0; column + 1 < z.columns; ++column) {
      const double east = z.at(column + 1, row) - z.at(column, row), north = z.at(column, row + 1) - z.at(column, row);
      if (std::isfinite(east + north))
        slope_deg.push_back(std::atan(std::hypot(east, north) / z.spacing_m) * 180.0 / std::numbers::pi);
    }
  }
  std::sort(slope_deg.begin(), slope_deg.end());
  ordered_json slopes;
  for (const auto& [name, p] : {std::pair{"p50", 0.5}, {"p95", 0.95}, {"p99.9", 0.999}})
    slopes[name] = slope_deg.empty() ? 0.0 : rounded(relief_statistics::percentile(slope_deg, p));
  return slopes;
}

ordered_json truth_of(const Opened& seabed, const Square& square) {
  const source::PostBlock block{std::llround(square.east_m / square.spacing_m),
                                std::llround(square.north_m / square.spacing_m), square.posts, square.posts,
                                square.spacing_m};
  Surface z{square.posts, square.posts, square.spacing_m, std::vector<float>(block.size())};
  std::vector<std::uint8_t> sediment(block.size());
  seabed.terrain->sample(block, z.height_m, sediment);
  float lowest = 1e9F, highest = -1e9F;
  std::map<std::uint8_t, double> shares;
  for (std::size_t i = 0; i < block.size(); ++i) {
    if (!std::isfinite(z.height_m[i]))
      throw UserError("--window " + square.name + ": the seabed has no height in a part of it");
    lowest = std::min(lowest, z.height_m[i]);
    highest = std::max(highest, z.height_m[i]);
    shares[sediment[i]] += 1.0 / static_cast<double>(block.size());
  }
  ordered_json truth{{"name", square.name},         {"east_m", block.east_m(0)},
                     {"north_m", block.north_m(0)}, {"spacing_m", square.spacing_m},
                     {"posts", square.posts},       {"depth_m", {rounded(-highest), rounded(-lowest)}}};
  ordered_json classes;
  for (const auto& [of_class, share] : shares) classes[std::to_string(of_class)] = rounded(share);
  truth["share_of_class"] = classes;
  truth["slope_deg"] = slopes_of(z);
  const auto patches = relief_statistics::patchiness(z);
  if (patches.patches == 0) return truth;  // level, or a plane's rounding: nothing to report
  const double pi = std::numbers::pi;
  const auto scaling = relief_statistics::scaling_exponents(z);
  const auto law = relief_statistics::fit_power_law(relief_statistics::radial_spectrum(z, 256),
                                                    2.0 * pi / (64.0 * z.spacing_m), pi / (2.0 * z.spacing_m));
  truth["exponent"] = rounded(law.exponent);
  truth["strength_at_1_radpm_m4"] = rounded(law.strength);
  truth["zeta"] = {rounded(scaling.zeta_1), rounded(scaling.zeta_2), rounded(scaling.zeta_3)};
  truth["k2"] = rounded(scaling.k2());
  truth["rms_over_median"] = rounded(patches.rms_over_median);
  truth["p95_over_p5"] = rounded(patches.p95_over_p5);
  truth["bimodality"] = rounded(patches.bimodality);
  truth["slope_correlation"] = rounded(patches.slope_correlation);
  truth["roughness"] = roughness_of(z);
  return truth;
}

int truth(const Options& options) {
  const Opened seabed = open_seabed(options.seabed);
  ordered_json all = ordered_json::array();
  for (const std::string& window : options.windows)
    all.push_back(truth_of(seabed, square_of(window, seabed.spacing_m)));
  fmt::print("{}\n", ordered_json{{"windows", all}}.dump(2));
  return kExitOk;
}

}  // namespace

Verb add_truth(CLI::App& parent) {
  auto options = std::make_shared<Options>();
  CLI::App* app = parent.add_subcommand(
      "truth",
      "Prints what a seabed measures in square windows, as JSON: depths, classes, slopes between posts, spectrum "
      "(exponent between 4 and 64 posts, strength at 1 rad/m), scaling exponents and K2 (lags 1 to 32 posts), "
      "patchiness "
      "(patches of 9 posts), roughness by window side. docs/physics/seabed/statistics.md says how each is measured.");
  app->add_option("seabed", options->seabed, "scenario file, or folder of a tile set")->required();
  app->add_option(
         "--window", options->windows,
         "NAME=EAST,NORTH[,SPACING[,POSTS]]: south-west corner in m, spacing (default: the seabed's own), posts "
         "per side (default: 1024); may be repeated")
      ->required()
      ->allow_extra_args(false);
  return {app, [options] { return truth(*options); }};
}

}  // namespace ensonify::terrain_tool
