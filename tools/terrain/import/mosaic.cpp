#include "tools/terrain/import/mosaic.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "components/errors/exit_error.h"
#include "components/terrain/raster_source.h"
#include "kernels/base/frames/local_projection.h"
#include "tools/terrain/import/survey_file.h"

namespace ensonify::terrain_import {
namespace {

using source::Extent;
using source::RasterSource;

constexpr int kRows = 256;  // posts that are taken from a file at once, by all columns
constexpr double kSteepest_deg = 60.0;

Extent joined(const Extent& a, const Extent& b) {
  return {std::min(a.west_m, b.west_m), std::min(a.south_m, b.south_m), std::max(a.east_m, b.east_m),
          std::max(a.north_m, b.north_m)};
}

/// Three digits are enough for a distance between posts that nobody asked for.
double rounded(double spacing_m) {
  const double unit = std::pow(10.0, std::floor(std::log10(spacing_m)) - 2.0);
  return std::stod(fmt::format("{:.3g}", std::max(unit, std::round(spacing_m / unit) * unit)));
}

/// Median slope from post to post.
double median_slope_deg(const terrain::Tile& tile) {
  std::vector<double> slope;
  const int every = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(tile.height_m.size()) / 1e5)));
  for (int row = 0; row + 1 < tile.rows; row += every) {
    for (int column = 0; column + 1 < tile.columns; column += every) {
      const double own = tile.height_m[tile.post(column, row)];
      const double rise =
          std::hypot(tile.height_m[tile.post(column + 1, row)] - own, tile.height_m[tile.post(column, row + 1)] - own);
      if (std::isfinite(rise)) slope.push_back(std::atan(rise / tile.spacing_m) * 180.0 / std::numbers::pi);
    }
  }
  if (slope.empty()) return 0.0;
  const auto middle = slope.begin() + static_cast<std::ptrdiff_t>(slope.size() / 2);
  std::nth_element(slope.begin(), middle, slope.end());
  return *middle;
}

/// Lets a user see that heights or places are in the wrong unit.
void refuse_walls(const terrain::Tile& tile, const std::vector<SurveyFile>& files) {
  const bool units_given =
      std::all_of(files.begin(), files.end(), [](const SurveyFile& f) { return f.options.units != "auto"; });
  const double slope_deg = median_slope_deg(tile);
  if (units_given || slope_deg < kSteepest_deg) return;
  files.front().raster->refuse(fmt::format(
      "is steeper than {:.0f} deg over half of its area: heights or places are probably in another unit than metres; "
      "say it with --units cm, mm, ft ..., or --units m if it really is so steep",
      kSteepest_deg));
}

void refuse_land(const terrain::Tile& tile, const std::vector<SurveyFile>& files, double lowest_m, double highest_m) {
  std::int64_t known = 0, above = 0;
  for (const float height : tile.height_m) {
    known += std::isnan(height) ? 0 : 1;
    above += height > 0.0F ? 1 : 0;
  }
  if (2 * above <= known) return;
  files.front().raster->refuse(fmt::format(
      "is mostly above the water (heights from {:.6g} to {:.6g} m up from chart datum), land alone cannot be surveyed: "
      "say --positive down for depths, or lower it to chart datum with --datum-shift METRES",
      lowest_m, highest_m));
}

constexpr int kSmoothing = 3;  // passes

}  // namespace

Mosaic::Mosaic(std::vector<SurveyFile>& files, const ImportOptions& options) : shares_(files.size()) {
  place_origin(files, options);
  double finest_m = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < files.size(); ++i) {
    const RasterSource file(files[i].raster, origin_);
    shares_[i].cell_m = file.native_spacing_m();
    shares_[i].surveyed_m2 = static_cast<double>(files[i].known_cells) * file.cell_area_m2();
    surveyed_ = i == 0 ? file.extent() : joined(surveyed_, file.extent());
    finest_m = std::min(finest_m, shares_[i].cell_m);
  }
  lay_posts(files, options.spacing_m > 0.0 ? options.spacing_m : rounded(finest_m));
  for (std::size_t i = 0; i < files.size(); ++i) {
    thin(files[i], tile_.spacing_m / shares_[i].cell_m);
    add(files[i], shares_[i]);
  }
  measure();
  refuse_walls(tile_, files);
  refuse_land(tile_, files, lowest_m_, highest_m_);
}

/// The middle of all files, to 1e-6 degrees (0.1 m), unless it is given.
void Mosaic::place_origin(const std::vector<SurveyFile>& files, const ImportOptions& options) {
  if (options.origin) {
    origin_ = *options.origin;
    return;
  }
  const RasterSource first(files.front().raster, std::nullopt);
  Extent all = first.extent();
  for (const SurveyFile& file : files) all = joined(all, RasterSource(file.raster, first.origin()).extent());
  const auto middle = frames::LocalProjection(first.origin())
                          .geodetic_of({(all.west_m + all.east_m) / 2.0, (all.south_m + all.north_m) / 2.0});
  const auto short_of = [](double degrees) { return std::stod(fmt::format("{:.6f}", degrees)); };
  origin_ = {short_of(middle.latitude_deg), short_of(middle.longitude_deg)};
}

void Mosaic::lay_posts(const std::vector<SurveyFile>& files, double spacing_m) {
  const auto first = [&](double m) { return static_cast<std::int64_t>(std::floor(m / spacing_m)); };
  const auto count = [&](double from_m, double to_m) {
    return std::ceil(to_m / spacing_m) - std::floor(from_m / spacing_m) + 1.0;
  };
  const double columns = count(surveyed_.west_m, surveyed_.east_m), rows = count(surveyed_.south_m, surveyed_.north_m);
  if (columns * rows > kMostCells) {
    throw UserError(
        fmt::format("{}: {:.0f} x {:.0f} posts {:.6g} m apart would be needed; at most {:.0e} are allowed: --spacing "
                    "{:.2g}, or cut out the survey area {}",
                    files.front().raster->name(), columns, rows, spacing_m, kMostCells,
                    1.05 * spacing_m * std::sqrt(columns * rows / kMostCells), kCutting));
  }
  first_east_ = first(surveyed_.west_m);
  first_north_ = first(surveyed_.south_m);
  tile_.spacing_m = spacing_m;
  tile_.columns = static_cast<std::int32_t>(columns);
  tile_.rows = static_cast<std::int32_t>(rows);
  tile_.origin_enu_m = {static_cast<double>(first_east_) * spacing_m, static_cast<double>(first_north_) * spacing_m};
  const auto posts = static_cast<std::size_t>(tile_.columns) * static_cast<std::size_t>(tile_.rows);
  tile_.height_m.assign(posts, std::numeric_limits<float>::quiet_NaN());
  tile_.sediment.assign(posts, 0);
}

source::PostBlock Mosaic::rows(int first, int count) const {
  return {first_east_, first_north_ + first, tile_.columns, std::min(count, tile_.rows - first), tile_.spacing_m};
}

void Mosaic::add(const SurveyFile& file, Share& share) {
  const RasterSource source(file.raster, origin_);
  std::optional<RasterSource> datum;
  if (!file.options.vertical.empty()) {
    FileOptions separations;
    separations.path = file.options.vertical;
    datum.emplace(std::make_shared<source::RasterFile>(raster_options(separations, origin_, std::nullopt)), origin_);
  }
  struct Sums {
    std::int64_t known = 0, used = 0, overlap = 0, without_datum = 0;
    double difference = 0.0, square = 0.0;
  };
  std::vector<Sums> sums(static_cast<std::size_t>((tile_.rows + kRows - 1) / kRows));
  tbb::parallel_for(std::size_t{0}, sums.size(), [&](std::size_t part) {
    const auto block = rows(static_cast<int>(part) * kRows, kRows);
    std::vector<float> height(block.size()), separation(datum ? block.size() : 0);
    std::vector<std::uint8_t> unused(block.size());
    source.sample(block, height, unused);
    if (datum) datum->sample(block, separation, unused);
    Sums& s = sums[part];
    float* taken = &tile_.height_m[part * kRows * static_cast<std::size_t>(tile_.columns)];
    for (std::size_t i = 0; i < height.size(); ++i) {
      if (std::isnan(height[i])) continue;
      const double up_m = height[i] + file.options.datum_shift_m + (datum ? static_cast<double>(separation[i]) : 0.0);
      if (std::isnan(up_m)) {
        ++s.without_datum;
        continue;
      }
      ++s.known;
      if (std::isnan(taken[i])) {
        taken[i] = static_cast<float>(up_m);
        ++s.used;
        continue;
      }
      ++s.overlap;
      s.difference += up_m - taken[i];
      s.square += (up_m - taken[i]) * (up_m - taken[i]);
    }
  });
  Sums all;
  for (const Sums& s : sums) {
    all.known += s.known, all.used += s.used, all.overlap += s.overlap, all.without_datum += s.without_datum;
    all.difference += s.difference, all.square += s.square;
  }
  const double post_m2 = tile_.spacing_m * tile_.spacing_m;
  share.known_m2 = static_cast<double>(all.known) * post_m2;
  share.used_m2 = static_cast<double>(all.used) * post_m2;
  share.without_datum = all.without_datum;
  share.overlap = all.overlap;
  if (all.overlap == 0) return;
  share.overlap_mean_m = all.difference / static_cast<double>(all.overlap);
  share.overlap_rms_m = std::sqrt(all.square / static_cast<double>(all.overlap));
}

void Mosaic::measure() {
  lowest_m_ = std::numeric_limits<double>::max();
  highest_m_ = std::numeric_limits<double>::lowest();
  for (const float height : tile_.height_m) {
    if (std::isnan(height)) continue;
    lowest_m_ = std::min<double>(lowest_m_, height);
    highest_m_ = std::max<double>(highest_m_, height);
  }
  if (lowest_m_ > highest_m_) {
    throw UserError(fmt::format(
        "no post gets a height: with posts {} m apart no four neighbouring cells with values lie around one; use a "
        "smaller --spacing or larger cells",
        tile_.spacing_m));
  }
}

Extent Mosaic::extent() const { return surveyed_; }

void Mosaic::sample(const source::PostBlock& posts, std::span<float> height_m, std::span<std::uint8_t> sediment) const {
  std::size_t k = 0;
  for (int row = 0; row < posts.rows; ++row) {
    for (int column = 0; column < posts.columns; ++column, ++k) {
      const std::int64_t east = posts.first_east + column - first_east_, north = posts.first_north + row - first_north_;
      const bool known = east >= 0 && north >= 0 && east < tile_.columns && north < tile_.rows;
      const std::size_t post =
          known ? tile_.post(static_cast<std::int32_t>(east), static_cast<std::int32_t>(north)) : 0;
      height_m[k] = known ? tile_.height_m[post] : std::numeric_limits<float>::quiet_NaN();
      sediment[k] = known ? tile_.sediment[post] : std::uint8_t{0};
    }
  }
}

double Mosaic::height_m(const frames::Vec2& place) const {
  return terrain::height_m(tile_, place).value_or(std::numeric_limits<double>::quiet_NaN());
}

HoleFacts fill(Mosaic& mosaic, const FillOptions& options) {
  terrain::Tile& tile = mosaic.tile();
  const survey_grid::Surface surface{tile.columns, tile.rows, tile.spacing_m, tile.height_m};
  const auto holes = survey_grid::holes_of(surface);
  const auto to_be_filled = [&](const survey_grid::Hole& hole) {
    return options.method != FillOptions::Method::kNone && !hole.at_rim &&
           hole.reach_spacings * tile.spacing_m <= options.reach_m;
  };
  HoleFacts facts;
  for (const auto& hole : holes.hole) {
    const double area_m2 = static_cast<double>(hole.posts) * tile.spacing_m * tile.spacing_m;
    if (hole.at_rim) {
      facts.outside_posts += hole.posts;
    } else if (to_be_filled(hole)) {
      ++facts.filled;
      facts.filled_posts += hole.posts;
    } else {
      ++facts.holes;
      facts.hole_posts += hole.posts;
      if (area_m2 <= facts.largest_m2) continue;
      facts.largest_m2 = area_m2;
      facts.largest_at_enu_m = tile.position_enu_m(hole.column, hole.row).head<2>();
    }
  }
  if (facts.filled == 0) return facts;
  std::vector<float> filled = tile.height_m;
  const int smoothing = options.method == FillOptions::Method::kSmooth ? kSmoothing : 0;
  const std::string fault =
      source::fill_holes(filled, tile.columns, tile.rows, options.reach_m / tile.spacing_m + 2.0, smoothing);
  if (!fault.empty()) throw UserError("--fill: the holes cannot be filled: " + fault);
  for (std::size_t post = 0; post < filled.size(); ++post) {
    const std::int32_t hole = holes.of_post[post];
    if (hole >= 0 && to_be_filled(holes.hole[static_cast<std::size_t>(hole)])) tile.height_m[post] = filled[post];
  }
  return facts;
}

}  // namespace ensonify::terrain_import
