#include "components/terrain_pager/corridor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "components/runtime/config/config_error.h"

namespace ensonify::pager {
namespace {

constexpr int kAcross = 12;  // places probed to either side of the line

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

/// Why a vehicle cannot be at a place; holes are nobody's business here.
std::optional<std::string> fault_at(const TerrainSource& terrain, const Vec2& place, std::optional<double> depth_m) {
  const double height_m = terrain.height_m(place);
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

std::optional<std::string> fault_of(const TerrainSource& terrain, const navigation::Runline& line,
                                    const CorridorRules& rules, std::optional<double> depth_m) {
  const Extent extent = terrain.extent();
  for (const Vec2& end : {line.start_enu_m, line.end_enu_m}) {
    if (!extent.contains(end)) {
      return "its end " + place_text(end) + " is outside the terrain; allowed is " + extent_text(extent);
    }
  }
  const double length = navigation::length_m(line);
  const double step = std::max(terrain.native_spacing_m(), length / 2000.0);
  const Vec2 along = (line.end_enu_m - line.start_enu_m) / length;
  const Vec2 starboard(along.y(), -along.x());
  const auto steps = static_cast<int>(std::ceil(length / step));
  for (int i = 0; i <= steps; ++i) {
    const Vec2 place = navigation::point_on(line, length * i / steps);
    if (const auto fault = fault_at(terrain, place, depth_m)) return fault;
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

void check_corridors(const TerrainSource& terrain, const std::vector<navigation::Runline>& runlines,
                     const CorridorRules& rules, const std::string& scenario_file) {
  std::vector<ConfigProblem> problems;
  for (std::size_t i = 0; i < runlines.size(); ++i) {
    if (const auto fault = fault_of(terrain, runlines[i], rules, i < rules.depth_m.size() ? rules.depth_m[i] : 0.0)) {
      problems.push_back({{scenario_file, 0, 0}, "mission runline " + std::to_string(i + 1), *fault});
    }
  }
  if (!problems.empty()) throw ConfigError(problems);
}

void check_places(const TerrainSource& terrain, const std::vector<VisitedPlace>& places,
                  const std::string& scenario_file) {
  std::vector<ConfigProblem> problems;
  const Extent extent = terrain.extent();
  for (const VisitedPlace& visited : places) {
    auto fault = fault_at(terrain, visited.place_enu_m, visited.depth_m);
    if (!extent.contains(visited.place_enu_m)) {
      fault = place_text(visited.place_enu_m) + " is outside the terrain; allowed is " + extent_text(extent);
    }
    if (fault) problems.push_back({{scenario_file, 0, 0}, "mission", *fault});
  }
  if (!problems.empty()) throw ConfigError(problems);
}

double shallowest_m(const TerrainSource& terrain, const std::vector<navigation::Runline>& runlines) {
  constexpr double kStep_m = 1.0;
  double highest_m = runlines.empty() ? terrain.highest_m() : terrain.lowest_m();
  for (const auto& line : runlines) {
    for (double along_m = 0.0; along_m <= navigation::length_m(line); along_m += kStep_m) {
      const double height_m = terrain.height_m(navigation::point_on(line, along_m));
      highest_m = std::isnan(height_m) ? highest_m : std::max(highest_m, height_m);
    }
  }
  return std::max(0.0, -highest_m);
}

}  // namespace ensonify::pager
