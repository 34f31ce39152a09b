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
#include "components/config/config_text.h"
#include "components/config/data_paths.h"
#include "components/config/parse_yaml.h"
#include "components/terrain/source_of.h"
#include "components/terrain_pager/meshes.h"
#include "components/terrain_pager/objects.h"
#include "components/tracks/followed_track.h"

namespace ensonify::pager {
namespace {

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

/// Pieces of a recorded track, as it is followed: of 10 m, or of a two-thousandth of a long one.
std::vector<Leg> followed_legs(const TerrainPagerConfig& config, const ConfigPlace& where, double lowest_water_m) {
  using Height = tracks::FollowedTrack::Height;
  constexpr double kShortLeg_m = 10.0, kMostLegs = 2000.0, kStep_s = 1.0;
  const tracks::FollowedTrack& track = *config.followed;
  const Vehicle& vehicle = *std::ranges::find(config.vehicles, config.follower_name, &Vehicle::name);
  std::vector<frames::Vec3> places;
  for (double t_s = 0.0; t_s < track.end_s(); t_s += kStep_s) places.push_back(track.at(t_s).pose.position_enu_m);
  places.push_back(track.at(track.end_s()).pose.position_enu_m);
  double length_m = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) length_m += (places[i] - places[i - 1]).head<2>().norm();
  const double leg_m = std::max(kShortLeg_m, length_m / kMostLegs);
  const auto depth_m = [&](const frames::Vec3& place) {
    if (track.height() == Height::kDatum) return lowest_water_m - place.z();
    if (track.height() == Height::kDepth) return -place.z();
    return vehicle.floats ? 0.0 : config.mission.depth_m;
  };
  std::vector<Leg> legs;
  std::size_t from = 0;
  double way_m = 0.0, deepest_m = depth_m(places.front());
  for (std::size_t i = 1; i < places.size(); ++i) {
    way_m += (places[i] - places[i - 1]).head<2>().norm();
    deepest_m = std::max(deepest_m, depth_m(places[i]));
    if (way_m < leg_m && i + 1 < places.size()) continue;
    const runlines::Runline line{places[from].head<2>(), places[i].head<2>()};
    if (runlines::length_m(line) > 0.0) {
      legs.push_back({line, deepest_m + lowest_head_m(vehicle), std::nullopt, where, "mission.follow"});
      legs.back().surveyed = true;
    }
    from = i;
    way_m = 0.0;
    deepest_m = depth_m(places[i]);
  }
  return legs;
}

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
  for (const char* rule : {"lawnmower", "adaptive", "auto", "follow"}) {
    if (const ConfigNode* found = keys.find(rule)) steps.push_back(found->place);
  }
  const ConfigNode* own = keys.find("file");
  if (!steps.empty() || own == nullptr || !own->is_scalar()) return;
  const std::string path = find_data(own->scalar, {std::filesystem::path(own->place.file).parent_path().string()});
  if (!path.empty()) find_steps(parse_config_file(path).root, steps);
}

}  // namespace

MissionTrack track_of(const TerrainPagerConfig& config) {
  const MissionPlaces where = mission_places(config.scenario_file, config.scenario_text);
  const std::vector<runlines::Runline>& runlines = config.mission.runlines;
  std::vector<VisitedPlace> starts;
  std::vector<Vec2> from;
  double least_reach_m = config.vehicles.empty() ? 0.0 : std::numeric_limits<double>::infinity();
  for (const Vehicle& vehicle : config.vehicles) {
    least_reach_m = std::min(least_reach_m, lowest_head_m(vehicle));
    if (vehicle.name == config.follower_name) continue;
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
  if (config.followed) track.legs = followed_legs(config, where.step(0), track.lowest_water_m);
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

std::optional<Vec2> first_place(const TerrainPagerConfig& config) {
  if (config.followed) return config.followed->at(0.0).pose.position_enu_m.head<2>();
  if (config.mission.runlines.empty()) return std::nullopt;
  return config.mission.runlines.front().start_enu_m;
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

void check_legs(const MissionTrack& track, const std::string& what, const progressive::TriangleMesh& mesh) {
  for (const Leg& leg : track.legs) {
    const double lowest_z_m = track.lowest_water_m - leg.reach_m;
    const auto along_m = progressive::first_crossing_m(mesh, {leg.line.start_enu_m, leg.line.end_enu_m, lowest_z_m});
    if (!along_m) continue;
    const frames::Vec2 place = runlines::point_on(leg.line, *along_m);
    throw ConfigError(
        {ConfigProblem{leg.place, leg.key,
                       fmt::format("at ({:.1f}, {:.1f}) m, {:.1f} m deep, it runs into {}; allowed is a way "
                                   "beside it, or above",
                                   place.x(), place.y(), leg.reach_m, what)}});
  }
}

void check_mission_alone(const TerrainPagerConfig& config) {
  const auto terrain = source::source_of(config.terrain);
  Meshes::Made made;
  const Meshes meshes(config, *terrain, made);
  const Objects objects(config, *terrain);
  check_mission(*terrain, config, Beyond::kAllowed);
}

}  // namespace ensonify::pager
