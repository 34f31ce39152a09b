#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <sstream>

#include "components/errors/exit_error.h"
#include "components/terrain/raster_source.h"
#include "tools/terrain/import/mosaic.h"
#include "tools/terrain/import/survey_file.h"

namespace ensonify::terrain_import {
namespace {

using source::RasterSource;

struct Condition {
  bool of_slope;  // else of depth
  bool above;     // else below
  double limit;   // degrees or metres
};

struct Rule {
  std::uint8_t sediment;
  std::vector<Condition> conditions;  // all must hold
};

/// "CLASS:depth>30,slope<5"
Rule rule_of(const std::string& text) {
  const auto wrong = [&]() {
    return UserError("--sediment-rule " + text +
                     ": is no rule; allowed is CLASS:CONDITION,... with depth>METRES, depth<METRES, slope>DEGREES, "
                     "slope<DEGREES and CLASS from 0 to 255");
  };
  const auto colon = text.find(':');
  if (colon == std::string::npos) throw wrong();
  const auto sediment = number_in(text.substr(0, colon));
  if (!sediment || *sediment < 0 || *sediment > 255 || *sediment != std::floor(*sediment)) throw wrong();
  Rule rule{static_cast<std::uint8_t>(*sediment), {}};
  std::istringstream rest(text.substr(colon + 1));
  for (std::string part; std::getline(rest, part, ',');) {
    const auto sign = part.find_first_of("<>");
    if (sign == std::string::npos) throw wrong();
    const std::string what = part.substr(0, sign);
    const auto limit = number_in(part.substr(sign + 1));
    if ((what != "depth" && what != "slope") || !limit) throw wrong();
    rule.conditions.push_back({what == "slope", part[sign] == '>', *limit});
  }
  if (rule.conditions.empty()) throw wrong();
  return rule;
}

/// Over one post to either side, or to one where the other is a hole; 0 where neither is known.
double slope_deg(const terrain::Tile& tile, int column, int row) {
  const auto rise = [&](int c, int r, int step_c, int step_r) {
    const auto height = [&](int cc, int rr) {
      return cc < 0 || rr < 0 || cc >= tile.columns || rr >= tile.rows ? std::numeric_limits<float>::quiet_NaN()
                                                                       : tile.height_m[tile.post(cc, rr)];
    };
    const double own = height(c, r), before = height(c - step_c, r - step_r), behind = height(c + step_c, r + step_r);
    if (std::isfinite(before) && std::isfinite(behind)) return (behind - before) / 2.0;
    if (std::isfinite(behind)) return behind - own;
    return std::isfinite(before) ? own - before : 0.0;
  };
  return std::atan(std::hypot(rise(column, row, 1, 0), rise(column, row, 0, 1)) / tile.spacing_m) * 180.0 /
         std::numbers::pi;
}

std::unique_ptr<const RasterSource> opened(const std::string& words, const Mosaic& mosaic,
                                           RasterSource::Between between) {
  if (words.empty()) return nullptr;
  const FileOptions file = file_of(words, {});
  auto raster = std::make_shared<source::RasterFile>(raster_options(file, mosaic.origin(), std::nullopt));
  if (!file.nodata.empty()) {
    auto cells = raster->read_all();
    drop_marked(cells, file.nodata);
    raster->hold(std::move(cells));
  }
  return std::make_unique<const RasterSource>(raster, mosaic.origin(), between);
}

/// A value of the class raster as a class.
std::uint8_t class_of(double value, const SedimentOptions& options) {
  if (!options.class_of_value.empty()) {
    const auto found = options.class_of_value.find(static_cast<int>(std::lround(value)));
    return found == options.class_of_value.end() ? options.otherwise : found->second;
  }
  if (value < 0.0 || value > 255.0 || value != std::floor(value)) {
    throw UserError(
        fmt::format("{}: holds {}, which is no class; whole numbers from 0 to 255 are allowed, or --class-map "
                    "VALUE=CLASS,... (a mark for missing values is declared with ?nodata=...)",
                    options.class_raster, value));
  }
  return static_cast<std::uint8_t>(value);
}

std::uint8_t class_of_backscatter(double value_db, const SedimentOptions& options) {
  const auto rank =
      static_cast<std::size_t>(std::upper_bound(options.thresholds_db.begin(), options.thresholds_db.end(), value_db) -
                               options.thresholds_db.begin());
  return options.backscatter_classes.empty() ? static_cast<std::uint8_t>(rank) : options.backscatter_classes[rank];
}

bool holds(const Rule& rule, double depth_m, double slope) {
  return std::all_of(rule.conditions.begin(), rule.conditions.end(), [&](const Condition& c) {
    const double value = c.of_slope ? slope : depth_m;
    return c.above ? value > c.limit : value < c.limit;
  });
}

void check(const SedimentOptions& options) {
  if (!options.backscatter.empty() && options.thresholds_db.empty())
    throw UserError("--sediment-backscatter needs --thresholds: rising dB values between the classes");
  if (!std::is_sorted(options.thresholds_db.begin(), options.thresholds_db.end()))
    throw UserError("--thresholds must rise, from the weakest bottom to the strongest");
  if (!options.backscatter_classes.empty() && options.backscatter_classes.size() != options.thresholds_db.size() + 1)
    throw UserError(fmt::format("--backscatter-classes names {} classes, and {} thresholds part {}",
                                options.backscatter_classes.size(), options.thresholds_db.size(),
                                options.thresholds_db.size() + 1));
}

}  // namespace

ClassPosts classify(Mosaic& mosaic, const SedimentOptions& options) {
  check(options);
  std::vector<Rule> rules;
  for (const auto& text : options.rules) rules.push_back(rule_of(text));
  const auto classes = opened(options.class_raster, mosaic, RasterSource::Between::kNearest);
  const auto backscatter = opened(options.backscatter, mosaic, RasterSource::Between::kBilinear);
  terrain::Tile& tile = mosaic.tile();
  ClassPosts count{};
  std::vector<float> value(static_cast<std::size_t>(tile.columns)), level(value.size());
  std::vector<std::uint8_t> unused(value.size());
  for (int row = 0; row < tile.rows; ++row) {
    if (classes) classes->sample(mosaic.rows(row, 1), value, unused);
    if (backscatter) backscatter->sample(mosaic.rows(row, 1), level, unused);
    for (int column = 0; column < tile.columns; ++column) {
      const std::size_t post = tile.post(column, row), i = static_cast<std::size_t>(column);
      if (std::isnan(tile.height_m[post])) continue;
      std::uint8_t& sediment = tile.sediment[post];
      sediment = options.otherwise;
      if (classes && !std::isnan(value[i])) {
        sediment = class_of(value[i], options);
      } else if (backscatter && !std::isnan(level[i])) {
        sediment = class_of_backscatter(level[i], options);
      } else if (!rules.empty()) {
        const double depth_m = -tile.height_m[post], slope = slope_deg(tile, column, row);
        const auto rule =
            std::find_if(rules.begin(), rules.end(), [&](const Rule& r) { return holds(r, depth_m, slope); });
        if (rule != rules.end()) sediment = rule->sediment;
      }
      ++count[sediment];
    }
  }
  return count;
}

}  // namespace ensonify::terrain_import
