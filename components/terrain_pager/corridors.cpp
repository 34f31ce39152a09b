#include "components/terrain_pager/corridors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace ensonify::pager {
namespace {

constexpr int kAcross = 12;            // places probed to either side of the line
constexpr double kMostSamples = 2000;  // along a line

std::string place_text(const Vec2& place) { return fmt::format("({:.1f}, {:.1f}) m", place.x(), place.y()); }

std::string extent_text(const Extent& extent) {
  return fmt::format("east {:.1f} to {:.1f} m and north {:.1f} to {:.1f} m", extent.west_m, extent.east_m,
                     extent.south_m, extent.north_m);
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
struct Samples {
  std::vector<Vec2> place;
  std::vector<double> height_m;  // as posts show it that are as far apart as the places; NaN in holes
};

Samples samples_along(const TerrainSource& terrain, const Leg& leg) {
  constexpr std::size_t kTogether = 64;  // places under one block of posts: each block costs some milliseconds at most
  const double length_m = runlines::length_m(leg.line);
  const double spacing_m = std::max({terrain.native_spacing_m(), leg.spacing_m, length_m / kMostSamples});
  const auto steps = static_cast<int>(std::ceil(length_m / spacing_m));
  Samples samples;
  for (int i = 0; i <= steps; ++i) samples.place.push_back(runlines::point_on(leg.line, length_m * i / steps));
  for (std::size_t first = 0; first < samples.place.size(); first += kTogether) {
    const auto some = std::span(samples.place).subspan(first, std::min(kTogether, samples.place.size() - first));
    const terrain::Tile posts = posts_around(terrain, some.front(), some.back(), spacing_m);
    for (const Vec2& place : some)
      samples.height_m.push_back(terrain::height_m(posts, place).value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return samples;
}

/// Why a vehicle cannot be at a place of that height; holes are nobody's business here.
std::optional<std::string> fault_at(const Vec2& place, double height_m, double reach_m, double lowest_water_m) {
  if (height_m >= lowest_water_m)
    return fmt::format("{} is land, {:.1f} m above chart datum with the lowest water at {:.1f} m; allowed is water",
                       place_text(place), height_m, lowest_water_m);
  if (height_m >= lowest_water_m - reach_m)
    return fmt::format(
        "at {} the vehicle would reach {:.1f} m deep and the seabed is {:.1f} m below the lowest water; "
        "allowed is less",
        place_text(place), reach_m, lowest_water_m - height_m);
  return std::nullopt;
}

/// Why a vehicle could never dive along a surveyed leg.
std::optional<std::string> too_shallow(const Leg& leg, const Samples& samples, const CorridorRules& rules) {
  double deepest_m = 0.0;
  for (const double height_m : samples.height_m)
    deepest_m = std::max(deepest_m, std::isnan(height_m) ? 0.0 : rules.lowest_water_m - height_m);
  const double above_bottom_m = leg.altitude_m.value_or(rules.least_altitude_m);
  if (deepest_m <= 0.0 || above_bottom_m < deepest_m) return std::nullopt;
  return fmt::format("{} {:.1f} leaves no depth to dive to, the deepest place is at {:.1f} m; allowed is less",
                     leg.altitude_m ? "altitude_m" : "least_altitude_m", above_bottom_m, deepest_m);
}

/// The first place of its corridor that has no height.
std::optional<Vec2> hole_beside(const TerrainSource& terrain, const Vec2& place, const Vec2& starboard,
                                double half_swath_rad) {
  const double height = terrain.height_m(place);
  const double reach = std::tan(half_swath_rad) * std::max(0.0, -height);
  for (int k = -kAcross; k <= kAcross; ++k) {
    const Vec2 probe = place + starboard * (std::isnan(height) ? 0.0 : reach * k / kAcross);
    if (terrain.extent().contains(probe) && std::isnan(terrain.height_m(probe))) return probe;
  }
  return std::nullopt;
}

std::optional<std::string> fault_of(const TerrainSource& terrain, const Leg& leg, const Samples& samples,
                                    const CorridorRules& rules) {
  const Extent extent = terrain.extent();
  for (const Vec2& end : {leg.line.start_enu_m, leg.line.end_enu_m}) {
    if (rules.refuse_beyond && !extent.contains(end))
      return "its end " + place_text(end) + " is outside the terrain; allowed is " + extent_text(extent);
  }
  if (leg.surveyed) {
    if (const auto fault = too_shallow(leg, samples, rules)) return fault;
  }
  const Vec2 along = (leg.line.end_enu_m - leg.line.start_enu_m) / runlines::length_m(leg.line);
  const Vec2 starboard(along.y(), -along.x());
  for (std::size_t i = 0; i < samples.place.size(); ++i) {
    if (const auto fault = fault_at(samples.place[i], samples.height_m[i], leg.reach_m, rules.lowest_water_m))
      return fault;
    if (!leg.surveyed || !rules.refuse_holes) continue;
    if (const auto hole = hole_beside(terrain, samples.place[i], starboard, rules.half_swath_rad)) {
      return "the terrain has a hole at " + place_text(*hole) +
             " inside the surveyed corridor; move the line, or set seabed.raster.holes to keep or fill";
    }
  }
  return std::nullopt;
}

/// Adds a problem unless there is one of its key and place.
void add(std::vector<ConfigProblem>& problems, const ConfigPlace& place, const std::string& key,
         const std::string& fault) {
  const bool known = std::any_of(problems.begin(), problems.end(), [&](const ConfigProblem& problem) {
    return problem.key == key && problem.place.line == place.line && problem.place.column == place.column;
  });
  if (!known) problems.push_back({place, key, fault});
}

}  // namespace

double check_corridors(const TerrainSource& terrain, const std::vector<Leg>& legs, const CorridorRules& rules) {
  std::vector<ConfigProblem> problems;
  const bool surveys = std::any_of(legs.begin(), legs.end(), [](const Leg& leg) { return leg.surveyed; });
  double highest_m = surveys ? terrain.lowest_m() : terrain.highest_m();
  for (const Leg& leg : legs) {
    const Samples samples = samples_along(terrain, leg);
    for (const double height_m : samples.height_m)
      if (leg.surveyed && !std::isnan(height_m)) highest_m = std::max(highest_m, height_m);
    if (const auto fault = fault_of(terrain, leg, samples, rules)) add(problems, leg.place, leg.key, *fault);
  }
  if (!problems.empty()) throw ConfigError(problems);
  return std::max(0.0, -highest_m);
}

void check_places(const TerrainSource& terrain, const std::vector<VisitedPlace>& places, const CorridorRules& rules) {
  std::vector<ConfigProblem> problems;
  const Extent extent = terrain.extent();
  for (const VisitedPlace& visited : places) {
    const Vec2& place = visited.place_enu_m;
    std::optional<std::string> fault;
    if (extent.contains(place)) {
      fault = fault_at(place, terrain.height_m(place), visited.reach_m, rules.lowest_water_m);
    } else if (rules.refuse_beyond) {
      fault = place_text(place) + " is outside the terrain; allowed is " + extent_text(extent);
    }
    if (fault) add(problems, visited.place, visited.key, *fault);
  }
  if (!problems.empty()) throw ConfigError(problems);
}

}  // namespace ensonify::pager
