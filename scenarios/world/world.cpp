#include "scenarios/world/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <set>
#include <stdexcept>

#include "components/config/config_error.h"
#include "components/config/config_node.h"
#include "components/config/data_paths.h"
#include "components/config/read_parameters.h"
#include "components/errors/assert.h"
#include "components/errors/nearest_name.h"
#include "kernels/vehicle/runlines/survey_plan.h"
#include "scenarios/world/scenario_keys.h"

namespace ensonify {

namespace {

/// How long one round of a mission's steps takes at the least: its lines, orbits and stays, without the ways between.
/// Begins at a speed and leaves the one that is in force after it.
double least_round_s(const Mission& mission, double& speed_mps) {
  double round_s = 0.0;
  for (const MissionStep& step : mission.steps) {
    if (const auto* go = std::get_if<GoAt>(&step)) speed_mps = go->speed_mps.value_or(speed_mps);
    if (const auto* keep = std::get_if<KeepPlace>(&step)) round_s += keep->for_s;
    if (const auto* orbit = std::get_if<FollowOrbit>(&step)) {
      round_s += 2.0 * std::numbers::pi * orbit->radius_m * orbit->turns / speed_mps;
    }
    if (const auto* line = std::get_if<FollowLine>(&step)) {
      double way_m = mission.run_in_m + mission.run_out_m;
      for (std::size_t i = 1; i < line->points_enu_m.size(); ++i) {
        way_m += (line->points_enu_m[i] - line->points_enu_m[i - 1]).norm();
      }
      round_s += way_m / speed_mps;
    }
  }
  return round_s;
}

double least_duration_s(const Mission& mission) {
  double speed_mps = mission.speed_mps;
  const double first_s = least_round_s(mission, speed_mps), next_s = least_round_s(mission, speed_mps);
  const double all_s = first_s + (mission.repeat - 1) * next_s;
  return std::min(all_s, mission.abort.after_s.value_or(all_s));
}

/// A tide must be known from the start for as long as the mission takes at the least.
void check_tide(ConfigReader& from, const World& world) {
  const double least_s = least_duration_s(world.mission);
  const vertical::Tide& tide = world.vertical.tide;
  if (tide.first_s() > 0.0) {
    from.problem("vertical",
                 fmt::format("the tide's first reading is {:.0f} s after the start; allowed: one at the start "
                             "or before",
                             tide.first_s()));
  } else if (tide.last_s() < least_s) {
    from.problem("vertical",
                 fmt::format("the tide's last reading is {:.0f} s after the start, and the mission takes {:.0f} s "
                             "without its turns; allowed: a file that covers the survey",
                             tide.last_s(), least_s));
  }
}

/// What grids must cover, as far as it is known: corners of a generated seabed, ends of runlines, vehicles at the
/// start.
std::vector<frames::Vec2> places_of_site(const World& world) {
  std::vector<frames::Vec2> places;
  if (world.seabed.kind == Seabed::Kind::kLayers) {
    const frames::Vec2 half_m = 0.5 * world.seabed.layered.size_m;
    for (const double east : {-half_m.x(), half_m.x()}) {
      for (const double north : {-half_m.y(), half_m.y()}) {
        places.push_back(world.seabed.layered.centre_enu_m + frames::Vec2(east, north));
      }
    }
  }
  for (const auto& line : world.mission.runlines) places.insert(places.end(), {line.start_enu_m, line.end_enu_m});
  for (const auto& vehicle : world.vehicles) {
    if (vehicle.start) places.emplace_back(vehicle.start->position_enu_m.head<2>());
  }
  return places;
}

/// Grids of datums must cover the site: beyond its edge a grid knows nothing.
void check_datums(const ConfigReader& from, const World& world) {
  const vertical::Datums& datums = world.vertical.datums;
  const std::vector<frames::Vec2> places = places_of_site(world);
  const auto check = [&](const std::string& key, const vertical::Separation& separation) {
    const auto bare = std::ranges::find_if(places, [&](const auto& place) { return !separation.covers(place); });
    if (bare == places.end()) return;
    from.problem("vertical." + key, fmt::format("does not cover ({:.1f}, {:.1f}) m; allowed: a grid over the whole "
                                                "seabed and all lines, east and north in metres of the world",
                                                bare->x(), bare->y()));
  };
  check("geoid_above_ellipsoid_grid", datums.geoid_above_ellipsoid);
  check("datum_above_geoid_grid", datums.datum_above_geoid);
}

/// Steps set heads that a vehicle carries.
void check_sonars(const ConfigReader& from, const Mission& mission, const std::set<std::string>& heads) {
  std::vector<ConfigProblem> unknown;
  for (const MissionStep& step : mission.steps) {
    const auto* sonar = std::get_if<SetSonar>(&step);
    if (sonar == nullptr || heads.contains(sonar->head)) continue;
    const std::string near = nearest_name(sonar->head, {heads.begin(), heads.end()});
    ConfigProblem& problem = unknown.emplace_back(sonar->given.at("set_sonar"));
    problem.message = fmt::format("no vehicle carries a head named \"{}\"; {}", sonar->head,
                                  !near.empty()   ? "did you mean " + near + "?"
                                  : heads.empty() ? "there is none"
                                                  : fmt::format("allowed: {}", fmt::join(heads, ", ")));
  }
  if (!unknown.empty()) from.add(ConfigError(unknown));
}

void check_follower(const ConfigReader& from, const World& world) {
  if (!world.mission.follow || follower(world) != nullptr) return;
  std::vector<std::string> names;
  for (const Vehicle& vehicle : world.vehicles) names.push_back(vehicle.name);
  const std::string& wanted = world.mission.follow->vehicle;
  const std::string cause = wanted.empty() ? "is missing: several vehicles could follow the track"
                                           : fmt::format("\"{}\" is no vehicle of the scenario", wanted);
  from.problem("mission", fmt::format("follow.vehicle {}; allowed: {}", cause, fmt::join(names, ", ")));
}

void check_whole(ConfigReader& from, const World& world) {
  if (from.good()) check_tide(from, world);
  std::set<std::string> heads;
  for (const auto& vehicle : world.vehicles) {
    for (const auto& [head, mounting] : vehicle.mountings) {
      if (!heads.insert(head).second) {
        from.problem("vehicles", "two vehicles carry a head named " + head);
      }
    }
    if (!world.mission.follow) check_mission(from, world.mission, vehicle, world.current);
    if (!world.mission.follow || vehicle.floats) check_heads(from, world.mission, vehicle);
  }
  check_follower(from, world);
  const bool nobody_dives = std::ranges::all_of(world.vehicles, [](const Vehicle& v) { return v.floats.has_value(); });
  if (world.mission.depth_m > 0.0 && nobody_dives && !world.vehicles.empty()) {
    from.problem("mission", "depth_m needs a vehicle that dives; " + world.vehicles.front().name + " floats");
  }
  check_sonars(from, world.mission, heads);
  const bool generated = world.seabed.kind == Seabed::Kind::kLayers;
  if (world.site.origin_from_raster && generated) {
    from.problem("site", "origin: raster needs seabed.kind: raster or tiles");
  }
}

/// Of `mission: { auto: }` in a scenario's file. What stands elsewhere, as a launch file may say it, has the file
/// alone.
ConfigPlace place_of_auto(const std::string& scenario_file) {
  const ConfigPlace file{scenario_file, 0, 0};
  if (!std::filesystem::is_regular_file(scenario_file)) return file;
  const ConfigNode world = load_scenario(scenario_file).root;
  const ConfigNode* mission = world.find("mission");
  const ConfigNode* wanted = mission != nullptr ? mission->find("auto") : nullptr;
  return wanted != nullptr ? wanted->place : file;
}

}  // namespace

void SiteKeys::check(const ConfigReader& from) const {
  if (from.has("origin") && (from.has("latitude_deg") || from.has("longitude_deg"))) {
    from.problem("origin", "stands beside latitude_deg or longitude_deg; give one or the other");
  }
}

Site SiteKeys::site() const {
  Site site;
  site.name = name;
  if (const auto* place = std::get_if<OriginKeys>(&origin)) site.origin = place->place;
  else site.origin_from_raster = true;
  return site;
}

ParameterList scenario_list() { return parameters_of<ScenarioFileKeys>(); }
ParameterList mission_file_list() { return parameters_of<MissionFileKeys>(); }
ParameterList step_list() { return parameters_of<MissionStep>(); }

World read_world(ConfigReader& from, const std::string& file, std::string* written) {
  ScenarioKeys keys;
  read_parameters(from, keys);
  if (written != nullptr) *written = written_yaml(parameters_of(keys, &from.node()));

  World world;
  static_cast<ScenarioHeader&>(world) = keys.header.header();
  world.file = file;
  world.site = keys.site.site();
  world.water = keys.water.water();
  const double start_unix_s = static_cast<double>(world.start_unix_ns) * 1e-9;
  world.vertical = keys.vertical.vertical(from, start_unix_s);
  world.current = keys.current.current(start_unix_s);
  world.seabed = keys.seabed.seabed();
  world.objects = objects_of(from, keys.objects, world.seabed, world.seed);
  for (const VehicleKeys& vehicle : keys.vehicles) world.vehicles.push_back(vehicle.vehicle());
  world.seabed.layered.seed = world.seed;
  world.seabed.layered.file = file;
  const bool placed = !world.site.origin_from_raster;
  world.mission = keys.mission.mission(placed ? std::optional(world.site.origin) : std::nullopt);
  if (from.good()) check_datums(from, world);
  check_whole(from, world);
  return world;
}

World read_world(const std::string& path, const Overrides& overrides) {
  const std::string found = find_data(path, {""});
  const std::string& file = found.empty() ? path : found;
  ConfigReader from(load_scenario(file, overrides));
  World world = read_world(from, file);
  from.finish();
  return world;
}

World World::read(const ScenarioFile& scenario) {
  World world;
  if (!scenario.path.empty()) {
    ConfigReader from(scenario.document);
    world = read_world(from, scenario.path);
    from.finish();
  }
  world.text = scenario.text;
  world.end_ns = scenario.end_ns;
  return world;
}

const Vehicle& World::vehicle(const std::string& name) const {
  if (name.empty() && vehicles.size() == 1) {
    return vehicles.front();
  }
  for (const auto& vehicle : vehicles) {
    if (vehicle.name == name) {
      return vehicle;
    }
  }
  throw std::out_of_range("the scenario has no vehicle named \"" + name + "\"");
}

std::optional<std::pair<std::string, HeadMounting>> World::mounting(const std::string& head) const {
  for (const auto& vehicle : vehicles) {
    if (const auto found = vehicle.mountings.find(head); found != vehicle.mountings.end()) {
      return std::pair{vehicle.name, found->second};
    }
  }
  return std::nullopt;
}

MissionPlan MissionPlan::of(const World& world, const Vehicle& vehicle) {
  return {world.file, world.mission, vehicle.limits};
}

std::vector<runlines::Runline> planned_lines(const MissionPlan& plan, const msg::Chart& chart) {
  const Mission& mission = plan.mission;
  if (!mission.auto_plan) return mission.runlines;
  const AutoPlan& wanted = *mission.auto_plan;

  runlines::HeightGrid ground;
  ground.west_m = chart.west_m;
  ground.south_m = chart.south_m;
  ground.spacing_m = chart.spacing_m;
  ground.columns = chart.height_m.cols();
  ground.rows = chart.height_m.rows();
  ground.height_m = chart.height_m.flat();

  runlines::SurveyRequest request;
  request.most_lines = wanted.count;
  request.longest_line_m = wanted.longest_m;
  request.swath_rad = wanted.swath_rad;
  request.overlap = wanted.overlap;
  request.spacing_m = wanted.spacing_m;
  request.heading_rad = wanted.heading_rad;
  request.head_height_m = -mission.depth_m;
  request.run_in_m = mission.run_in_m;
  request.turn_room_m = mission.run_in_m + 2.0 * plan.limits.turning_radius_m;
  try {
    return runlines::plan_survey(ground, request).lines;
  } catch (const runlines::NoRoom& no_room) {
    throw ConfigError(
        {{place_of_auto(plan.scenario_file), "mission.auto", std::string("no room for a survey: ") + no_room.what()}});
  }
}

motion::State start_of(const MissionPlan& plan, const std::vector<runlines::Runline>& lines) {
  ENSONIFY_ASSERT(!lines.empty(), "a mission has at least one line");
  const frames::Vec2 start = runlines::extended(lines.front(), plan.mission.run_in_m, 0.0).start_enu_m;
  return {{start.x(), start.y(), -plan.mission.depth_m}, runlines::heading_rad(lines.front()), plan.mission.speed_mps};
}

}  // namespace ensonify
