#include "components/terrain_pager/mission_track.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "components/config/config_node.h"
#include "components/config/data_paths.h"
#include "components/terrain/source_of.h"
#include "components/terrain_pager/meshes.h"

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

constexpr int kOrbitSides = 32;           // of a polygon for an orbit: within 0.5 % of its radius
constexpr double kMostInRectangle = 1e4;  // places of an adaptive survey that are examined
constexpr double kFinest_m = 0.5;         // between lines over a small one

/// How far the lowest head of a vehicle is below its reference point; 0 where all are above.
double lowest_head_m(const Vehicle& vehicle) {
  double lowest_m = 0.0;
  for (const auto& [head, mounting] : vehicle.mountings)
    lowest_m = std::max(lowest_m, mounting.actual.position_body_m.z());
  return lowest_m;
}

/// Goes through a mission as the pilot does.
class Walk {
 public:
  Walk(const Mission& mission, const MissionPlaces& where, double lowest_head_m, std::vector<Vec2> from)
      : mission_(mission), where_(where), lowest_head_m_(lowest_head_m), at_(std::move(from)) {
    if (!mission.altitude_m) depth_m_ = mission.depth_m;
    altitude_m_ = mission.altitude_m;
  }

  MissionTrack track() && {
    round();
    const bool another_depth = depth_m_ != (mission_.altitude_m ? std::nullopt : std::optional(mission_.depth_m));
    if (mission_.repeat > 1 && another_depth) round();
    if (mission_.adaptive) follow_all_of(*mission_.adaptive);
    return std::move(track_);
  }

 private:
  void round() {
    runlines_ = 0;
    for (std::size_t i = 0; i < mission_.steps.size(); ++i) {
      here_ = where_.step(i);
      std::visit([this](const auto& step) { go(step); }, mission_.steps[i]);
    }
  }

  void go(const FollowLine& line) {
    const auto& points = line.points_enu_m;
    const std::size_t last = points.size() - 1;
    const Vec2 before = runlines::extended({points[0], points[1]}, mission_.run_in_m, 0.0).start_enu_m;
    const Vec2 behind = runlines::extended({points[last - 1], points[last]}, 0.0, mission_.run_out_m).end_enu_m;
    if (mission_.run_in_m > 0.0) add("mission run-in", {before, points[0]});
    for (std::size_t i = 0; i < last; ++i)
      add(fmt::format("mission runline {}", ++runlines_), {points[i], points[i + 1]}).surveyed = true;
    if (mission_.run_out_m > 0.0) add("mission run-out", {points[last], behind});
    at_ = {behind};
  }
  void go(const PassPlace& pass) { visit({pass.place_enu_m}); }
  void go(const KeepPlace& keep) {
    if (keep.place_enu_m) visit({*keep.place_enu_m});
  }
  void go(const FollowOrbit& orbit) {
    at_.clear();
    for (int i = 0; i < kOrbitSides; ++i) {
      const double bearing = 2.0 * std::numbers::pi * i / kOrbitSides;
      at_.emplace_back(orbit.centre_enu_m + orbit.radius_m * Vec2(std::sin(bearing), std::cos(bearing)));
    }
    for (std::size_t i = 0; i < at_.size(); ++i) add("mission orbit", {at_[i], at_[(i + 1) % at_.size()]});
  }
  void go(const GoAt& order) {
    depth_m_ = depth_after(order, depth_m_);
    if (order.depth_m) altitude_m_.reset();
    if (order.altitude_m) altitude_m_ = order.altitude_m;
    if (order.depth_m) visit(at_);
  }
  void go(const SetSonar&) {}
  void go(const SetMark&) {}

  /// Lines all over the rectangle, for coverage alone decides where they are run.
  void follow_all_of(const AdaptivePlan& plan) {
    const double spacing_m = std::sqrt(plan.length_m * plan.width_m / kMostInRectangle);
    const double further_m = std::max(mission_.run_in_m, mission_.run_out_m);  // they are run either way
    const int count = static_cast<int>(std::ceil(plan.width_m / std::max(spacing_m, kFinest_m)));
    AdaptivePlan moved = plan;
    for (int i = 0; i <= count; ++i) {
      moved.first_line_m = plan.width_m * i / count;
      Leg& leg = add("mission adaptive", runlines::extended(first_line(moved), further_m, further_m));
      leg.surveyed = true;
      leg.spacing_m = spacing_m;
    }
  }

  double reach_m() const { return depth_m_.value_or(0.0) + lowest_head_m_; }
  Leg& add(std::string key, const runlines::Runline& line) {
    track_.legs.push_back({line, reach_m(), altitude_m_, here_, std::move(key)});
    return track_.legs.back();
  }
  void visit(std::vector<Vec2> places) {
    for (const Vec2& place : places) track_.places.push_back({place, reach_m(), here_, "mission"});
    at_ = std::move(places);
  }

  const Mission& mission_;
  const MissionPlaces& where_;
  double lowest_head_m_;
  std::vector<Vec2> at_;  // where the vehicle may be now
  std::optional<double> depth_m_, altitude_m_;
  ConfigPlace here_;
  int runlines_ = 0;
  MissionTrack track_;
};

/// A value of the file, if it is in force: a launch file may have put another in its place.
const ConfigNode* in_force(const ConfigNode* of_file, const ConfigNode* in_run) {
  const bool same =
      of_file != nullptr && in_run != nullptr && to_canonical_yaml(*of_file) == to_canonical_yaml(*in_run);
  return same ? of_file : nullptr;
}

/// The keys of a mission may stand in a file of their own.
void find_steps(const ConfigNode& keys, std::vector<ConfigPlace>& steps) {
  for (const char* list : {"runlines", "steps"}) {
    const ConfigNode* found = keys.find(list);
    for (std::size_t i = 0; found != nullptr && i < found->items.size(); ++i) steps.push_back(found->items[i].place);
  }
  for (const char* rule : {"lawnmower", "adaptive", "auto"}) {
    if (const ConfigNode* found = keys.find(rule)) steps.push_back(found->place);
  }
  const ConfigNode* own = keys.find("file");
  if (!steps.empty() || own == nullptr || !own->is_scalar()) return;
  const std::string path = find_data(own->scalar, {std::filesystem::path(own->place.file).parent_path().string()});
  if (!path.empty()) find_steps(parse_config_file(path).root, steps);
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

MissionTrack track_of(const TerrainPagerConfig& config) {
  const MissionPlaces where = mission_places(config.scenario_file, config.scenario_text);
  const std::vector<runlines::Runline>& runlines = config.mission.runlines;
  std::vector<VisitedPlace> starts;
  std::vector<Vec2> from;
  double least_reach_m = config.vehicles.empty() ? 0.0 : std::numeric_limits<double>::infinity();
  for (const Vehicle& vehicle : config.vehicles) {
    least_reach_m = std::min(least_reach_m, lowest_head_m(vehicle));
    if (!vehicle.start) {
      if (!runlines.empty()) from.push_back(runlines::extended(runlines[0], config.mission.run_in_m, 0.0).start_enu_m);
      continue;
    }
    const frames::Vec3& place = vehicle.start->position_enu_m;  // up from the water level
    from.push_back(place.head<2>());
    starts.push_back({place.head<2>(), lowest_head_m(vehicle) + (vehicle.floats ? 0.0 : -place.z()),
                      where.start(vehicle.name), "vehicles." + vehicle.name + ".start"});
  }
  MissionTrack track = Walk(config.mission, where, least_reach_m, from).track();
  track.places.insert(track.places.end(), starts.begin(), starts.end());
  track.lowest_water_m = lowest_water_m(config.tide, config.duration);
  return track;
}

double lowest_water_m(const vertical::Tide& tide, std::optional<SimTime> duration) {
  constexpr double kStep_s = 300.0, kLongest_s = 30 * 86400.0;
  const double until_s = duration ? std::min(seconds(*duration), kLongest_s) : kLongest_s;
  double lowest_m = std::min(tide.at(0.0).height_m, tide.at(until_s).height_m);
  for (double t_s = kStep_s; t_s < until_s; t_s += kStep_s) lowest_m = std::min(lowest_m, tide.at(t_s).height_m);
  return lowest_m;
}

const ConfigPlace& MissionPlaces::step(std::size_t i) const {
  return steps.empty() ? mission : steps[std::min(i, steps.size() - 1)];
}

const ConfigPlace& MissionPlaces::start(const std::string& vehicle) const {
  const auto found = starts.find(vehicle);
  return found == starts.end() ? mission : found->second;
}

MissionPlaces mission_places(const std::string& scenario_file, const std::string& scenario_text) {
  MissionPlaces places{{scenario_file, 0, 0}, {}, {}};
  if (scenario_text.empty() || !std::filesystem::is_regular_file(scenario_file)) return places;
  const ConfigNode file = load_scenario(scenario_file).root;
  const ConfigNode run = parse_config(scenario_text, scenario_file).root;
  if (const ConfigNode* vehicles = file.find("vehicles"); vehicles != nullptr && run.find("vehicles") != nullptr) {
    for (const auto& vehicle : vehicles->entries) {
      const ConfigNode* steered = run.find("vehicles")->find(vehicle.key);
      const ConfigNode* start = in_force(vehicle.value.find("start"), steered ? steered->find("start") : nullptr);
      places.starts[vehicle.key] = start != nullptr ? start->place : places.mission;
    }
  }
  if (const ConfigNode* mission = in_force(file.find("mission"), run.find("mission"))) {
    places.mission = mission->place;
    find_steps(*mission, places.steps);
  }
  return places;
}

double check_mission(const source::TerrainSource& terrain, const TerrainPagerConfig& config, Beyond beyond) {
  const auto holes = config.terrain.seabed.kind == Seabed::Kind::kRaster ? config.terrain.seabed.raster.holes
                                                                         : RasterSeabed::Holes::kKeep;
  const MissionTrack track = track_of(config);
  CorridorRules rules;
  rules.half_swath_rad = config.corridor_half_deg * std::numbers::pi / 180.0;
  rules.refuse_holes = beyond == Beyond::kRefused && holes == RasterSeabed::Holes::kRefuse;
  rules.refuse_beyond = beyond == Beyond::kRefused;
  rules.least_altitude_m = config.mission.least_altitude_m;
  rules.lowest_water_m = track.lowest_water_m;
  const double shallowest_m = check_corridors(terrain, track.legs, rules);
  check_places(terrain, track.places, rules);
  return shallowest_m;
}

void check_mission_alone(const TerrainPagerConfig& config) {
  const auto terrain = source::source_of(config.terrain);
  const Meshes meshes(config, *terrain);
  check_mission(*terrain, config, Beyond::kAllowed);
}

}  // namespace ensonify::pager
