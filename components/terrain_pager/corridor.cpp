#include "components/terrain_pager/corridor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace ensonify::pager {
namespace {

constexpr int kAcross = 12;          // places probed to either side of the line
constexpr double kMostLooks = 2000;  // along a line

std::string place_text(const Vec2& place) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.1f, %.1f) m", place.x(), place.y());
  return text;
}

std::string extent_text(const Extent& extent) {
  char text[128];
  std::snprintf(text, sizeof text, "east %.1f to %.1f m and north %.1f to %.1f m", extent.west_m, extent.east_m,
                extent.south_m, extent.north_m);
  return text;
}

/// The posts of a lattice over the rectangle between two places.
terrain::Tile posts_around(const TerrainSource& terrain, const Vec2& a, const Vec2& b, double spacing_m) {
  const Vec2 low = a.cwiseMin(b) / spacing_m, high = a.cwiseMax(b) / spacing_m;
  const auto first_east = static_cast<std::int64_t>(std::floor(low.x()));
  const auto first_north = static_cast<std::int64_t>(std::floor(low.y()));
  const source::PostBlock block{
      first_east, first_north, static_cast<int>(static_cast<std::int64_t>(std::ceil(high.x())) - first_east) + 2,
      static_cast<int>(static_cast<std::int64_t>(std::ceil(high.y())) - first_north) + 2, spacing_m};
  terrain::Tile tile{{block.east_m(0), block.north_m(0)}, spacing_m, block.columns, block.rows, {}, {}};
  tile.height_m.resize(block.size());
  tile.sediment.resize(block.size());
  terrain.sample(block, tile.height_m, tile.sediment);
  return tile;
}

/// Places along a line, from one end to the other, and the heights there.
struct Looks {
  std::vector<Vec2> place;
  std::vector<double> height_m;  // as posts show it that are as far apart as the places; NaN in holes
};

Looks looks_along(const TerrainSource& terrain, const navigation::Runline& line) {
  constexpr std::size_t kTogether = 64;  // places under one block of posts: each block costs some milliseconds at most
  const double length_m = navigation::length_m(line);
  const double spacing_m = std::max(terrain.native_spacing_m(), length_m / kMostLooks);
  const auto steps = static_cast<int>(std::ceil(length_m / spacing_m));
  Looks looks;
  for (int i = 0; i <= steps; ++i) looks.place.push_back(navigation::point_on(line, length_m * i / steps));
  for (std::size_t first = 0; first < looks.place.size(); first += kTogether) {
    const auto some = std::span(looks.place).subspan(first, std::min(kTogether, looks.place.size() - first));
    const terrain::Tile posts = posts_around(terrain, some.front(), some.back(), spacing_m);
    for (const Vec2& place : some)
      looks.height_m.push_back(terrain::height_m(posts, place).value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return looks;
}

/// Why a vehicle cannot be at a place of that height; holes are nobody's business here.
std::optional<std::string> fault_at(const Vec2& place, double height_m, std::optional<double> depth_m) {
  char text[160];
  if (height_m >= 0.0) {
    std::snprintf(text, sizeof text, "%s is land, %.1f m above chart datum; allowed is water",
                  place_text(place).c_str(), height_m);
    return text;
  }
  if (depth_m && *depth_m > 0.0 && height_m >= -*depth_m) {
    std::snprintf(text, sizeof text,
                  "at %s the vehicle would be %.1f m deep and the seabed is at %.1f m; allowed is less",
                  place_text(place).c_str(), *depth_m, -height_m);
    return text;
  }
  return std::nullopt;
}

std::optional<std::string> fault_of(const TerrainSource& terrain, const navigation::Runline& line, const Looks& looks,
                                    const CorridorRules& rules, std::optional<double> depth_m) {
  const Extent extent = terrain.extent();
  for (const Vec2& end : {line.start_enu_m, line.end_enu_m}) {
    if (rules.refuse_beyond && !extent.contains(end)) {
      return "its end " + place_text(end) + " is outside the terrain; allowed is " + extent_text(extent);
    }
  }
  double deepest_m = 0.0;
  for (const double height_m : looks.height_m) deepest_m = std::max(deepest_m, std::isnan(height_m) ? 0.0 : -height_m);
  if (deepest_m > 0.0 && rules.least_altitude_m >= deepest_m) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "least_altitude_m %.1f leaves no depth to dive to, the deepest place is at %.1f m; allowed is less",
                  rules.least_altitude_m, deepest_m);
    return text;
  }
  const Vec2 along = (line.end_enu_m - line.start_enu_m) / navigation::length_m(line);
  const Vec2 starboard(along.y(), -along.x());
  for (std::size_t i = 0; i < looks.place.size(); ++i) {
    const Vec2& place = looks.place[i];
    if (const auto fault = fault_at(place, looks.height_m[i], depth_m)) return fault;
    if (!rules.refuse_holes) continue;
    const double height = terrain.height_m(place);
    const double reach = std::tan(rules.half_swath_rad) * std::max(0.0, -height);
    for (int k = -kAcross; k <= kAcross; ++k) {
      const Vec2 probe = place + starboard * (std::isnan(height) ? 0.0 : reach * k / kAcross);
      if (extent.contains(probe) && std::isnan(terrain.height_m(probe))) {
        return "the terrain has a hole at " + place_text(probe) +
               " inside the surveyed corridor; move the line, or set seabed.raster.holes to keep or fill";
      }
    }
  }
  return std::nullopt;
}

}  // namespace

double check_corridors(const TerrainSource& terrain, const std::vector<navigation::Runline>& runlines,
                       const CorridorRules& rules, const ConfigPlace& mission) {
  std::vector<ConfigProblem> problems;
  double highest_m = runlines.empty() ? terrain.highest_m() : terrain.lowest_m();
  for (std::size_t i = 0; i < runlines.size(); ++i) {
    const Looks looks = looks_along(terrain, runlines[i]);
    for (const double height_m : looks.height_m)
      highest_m = std::isnan(height_m) ? highest_m : std::max(highest_m, height_m);
    const std::optional<double> depth_m = i < rules.depth_m.size() ? rules.depth_m[i] : 0.0;
    if (const auto fault = fault_of(terrain, runlines[i], looks, rules, depth_m)) {
      const ConfigPlace& place = i < rules.place.size() ? rules.place[i] : mission;
      problems.push_back({place, "mission runline " + std::to_string(i + 1), *fault});
    }
  }
  if (!problems.empty()) throw ConfigError(problems);
  return std::max(0.0, -highest_m);
}

void check_places(const TerrainSource& terrain, const std::vector<VisitedPlace>& places, bool refuse_beyond) {
  std::vector<ConfigProblem> problems;
  const Extent extent = terrain.extent();
  for (const VisitedPlace& visited : places) {
    std::optional<std::string> fault;
    if (extent.contains(visited.place_enu_m)) {
      fault = fault_at(visited.place_enu_m, terrain.height_m(visited.place_enu_m), visited.depth_m);
    } else if (refuse_beyond) {
      fault = place_text(visited.place_enu_m) + " is outside the terrain; allowed is " + extent_text(extent);
    }
    if (fault) problems.push_back({visited.place, visited.key, *fault});
  }
  if (!problems.empty()) throw ConfigError(problems);
}

}  // namespace ensonify::pager
