#include "scenarios/world/mission.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/config/read_parameters.h"
#include "scenarios/world/sections.h"
#include "scenarios/world/world.h"

namespace ensonify {
namespace {

using runlines::Vec2;

constexpr double kWidestTurn_m = 1000.0;  // as turning_radius_m has: the largest ships need some hundred metres

struct Positions {
  bool geodetic = false;

  static void parameters(auto& self, auto&& visit) {
    visit("positions", "", one_of({{"metres", false}, {"geodetic", true}}),
          "places are [east, north] from the site's origin, or [latitude, longitude] in degrees", self.geodetic);
  }
};

/// A stay, whose key says whether it is at a place.
struct Stay {
  double for_s = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("for_s", "s", must(in(0, 1e6)), "how long the vehicle stays at the place", self.for_s);
  }
};
struct Wait {
  double for_s = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("wait_s", "s", must(in(0, 1e6)), "how long the vehicle stays where it is", self.for_s);
  }
};

struct Lawnmower {
  double heading_rad = 0.0, length_m = 0.0, spacing_m = 0.0;
  int count = 0;

  static void parameters(auto& self, auto&& visit) {
    visit("heading_deg", "deg", in(-360, 360), "of the first line", self.heading_rad);
    visit("length_m", "m", must(in(1, kFarAway_m)), "length of a line", self.length_m);
    visit("spacing_m", "m", must(in(0.1, kFarAway_m)), "from line to line", self.spacing_m);
    visit("count", "", must(in(1, 1000)), "number of lines", self.count);
  }
};

/// Reads places in the frame that the mission says.
class Places {
 public:
  Places(ConfigReader& from, const std::optional<frames::Geodetic>& origin) {
    Positions positions;
    read_parameters(from, positions);
    if (!positions.geodetic) return;
    if (origin) {
      projection_.emplace(*origin);
    } else {
      from.problem("positions", "geodetic needs a site with latitude_deg and longitude_deg");
    }
  }

  Vec2 required(ConfigReader& from, std::string_view key) const {
    std::array<double, 2> found{};
    from.required(key, found, lowest(), highest());
    return from.good() ? place(from, key, found) : Vec2(0, 0);
  }

  std::vector<Vec2> required_list(ConfigReader& from, std::string_view key) const {
    std::vector<std::array<double, 2>> found;
    from.required(key, found, lowest(), highest());
    std::vector<Vec2> places;
    for (const auto& each : found) places.push_back(place(from, key, each));
    return places;
  }

 private:
  double highest() const { return projection_ ? 180.0 : kFarAway_m; }
  double lowest() const { return -highest(); }

  Vec2 place(const ConfigReader& from, std::string_view key, const std::array<double, 2>& found) const {
    if (!projection_) return {found[0], found[1]};
    const double off_m = distance_m(found[0], found[1]);
    if (off_m > kFarAway_m) {
      const bool swapped = distance_m(found[1], found[0]) < kFarAway_m;
      from.problem(key, fmt::format("[{}, {}] is {} from the site's origin; allowed: 100 km{}", found[0], found[1],
                                    std::isfinite(off_m) ? fmt::format("{:.0f} km", 1e-3 * off_m) : "not a place",
                                    swapped ? "; are latitude and longitude swapped?" : ""));
      return {0, 0};
    }
    return projection_->enu_of({found[0], found[1]});
  }

  /// Roughly, by the sphere: the projection is not made for other continents.
  double distance_m(double latitude_deg, double longitude_deg) const {
    if (std::abs(latitude_deg) > 90.0) return INFINITY;
    const double r = kDegrees.si;
    const double a = latitude_deg * r, b = projection_->origin().latitude_deg * r;
    const double h = std::pow(std::sin(0.5 * (a - b)), 2) +
                     std::cos(a) * std::cos(b) *
                         std::pow(std::sin(0.5 * r * (longitude_deg - projection_->origin().longitude_deg)), 2);
    return 2.0 * 6371e3 * std::asin(std::min(1.0, std::sqrt(h)));
  }

  std::optional<frames::LocalProjection> projection_;
};

FollowLine read_line(ConfigReader& from, const Places& places) {
  const FollowLine line{places.required_list(from, "line")};
  if (!from.good()) return line;
  if (line.points_enu_m.size() < 2) from.problem("line", "has fewer than 2 places");
  for (std::size_t i = 1; i < line.points_enu_m.size(); ++i) {
    if ((line.points_enu_m[i] - line.points_enu_m[i - 1]).norm() < kShortest_m) {
      from.problem("line", fmt::format("place {} is less than 1 m from the one before", i + 1));
    }
  }
  return line;
}

FollowOrbit read_orbit(ConfigReader& from, const Places& places) {
  FollowOrbit orbit{places.required(from, "orbit")};
  read_parameters(from, orbit);
  return orbit;
}

SetSonar read_sonar(ConfigReader& from) {
  SetSonar sonar;
  read_parameters(from, sonar);
  sonar.given["set_sonar"] = from.problem_at("set_sonar", "");
  for_settings(sonar.settings, [&](const char* name, const char* unit, auto&&...) {
    const std::string key = setting_in_file(name, unit).key;
    if (from.has(key)) sonar.given[name] = from.problem_at(key, "");
  });
  return sonar;
}

MissionStep read_step(ConfigReader& from, const Places& places) {
  if (from.has("line")) return read_line(from, places);
  if (from.has("orbit")) return read_orbit(from, places);
  if (from.has("set_sonar")) return read_sonar(from);
  if (from.has("pass")) {
    PassPlace pass{places.required(from, "pass"), std::nullopt};
    read_parameters(from, pass);
    return pass;
  }
  if (from.has("keep") || from.has("wait_s")) {
    KeepPlace keep;
    if (from.has("keep")) {
      Stay stay;
      keep.place_enu_m = places.required(from, "keep");
      read_parameters(from, stay);
      keep.for_s = stay.for_s;
    } else {
      Wait wait;
      read_parameters(from, wait);
      keep.for_s = wait.for_s;
    }
    read_parameters(from, keep);
    return keep;
  }
  if (from.has("mark")) {
    SetMark mark;
    read_parameters(from, mark);
    return mark;
  }
  GoAt go;
  read_parameters(from, go);
  if (go.depth_m && go.altitude_m) from.problem("altitude_m", "stands beside depth_m; give one or the other");
  if (!from.has("speed_mps") && !from.has("depth_m") && !from.has("altitude_m")) {
    from.problem("",
                 "is no step; allowed: line, pass, keep, wait_s, orbit, set_sonar, mark, or speed_mps with depth_m "
                 "or altitude_m");
  }
  return go;
}

std::vector<runlines::Runline> read_lines(ConfigReader& from, const Places& places) {
  std::vector<runlines::Runline> lines;
  for (auto& item : from.list("runlines")) {
    const runlines::Runline line{places.required(item, "from_m"), places.required(item, "to_m")};
    if (item.good() && item.has("from_m") && item.has("to_m") && runlines::length_m(line) < kShortest_m) {
      item.problem("to_m", "is less than 1 m from from_m");
    }
    lines.push_back(line);
  }
  return lines;
}

std::vector<runlines::Runline> read_lawnmower(ConfigReader from, const Places& places) {
  Vec2 centre(0, 0);
  Lawnmower rows;
  if (from.has("centre_m")) centre = places.required(from, "centre_m");
  read_parameters(from, rows);
  return from.good() ? runlines::lawnmower(centre, rows.heading_rad, rows.length_m, rows.spacing_m, rows.count)
                     : std::vector<runlines::Runline>{};
}

AdaptivePlan read_adaptive(ConfigReader from, const Places& places) {
  AdaptivePlan plan;
  plan.centre_enu_m = places.required(from, "centre_m");
  read_parameters(from, plan);
  if (from.good() && plan.first_line_m > plan.width_m) from.problem("first_line_m", "lies beyond width_m");
  if (from.good() && plan.length_m * plan.width_m > 4e6 * plan.cell_m * plan.cell_m) {
    from.problem("cell_m", "makes more than 4 million cells; allowed: larger cells or a smaller rectangle");
  }
  return plan;
}

/// The keys that a mission file and the section of a scenario share. Gives how many plans they hold.
int read_keys(ConfigReader& from, const std::optional<frames::Geodetic>& origin, Mission& mission) {
  if (from.has("speed_kn") && from.has("speed_mps")) {
    from.problem("speed_kn", "stands beside speed_mps; give one or the other");
  }
  const Places places(from, origin);
  read_parameters(from, mission);
  if (from.has("runlines")) mission.steps = steps_of(read_lines(from, places));
  if (const auto section = from.optional_section("lawnmower")) {
    mission.steps = steps_of(read_lawnmower(*section, places));
  }
  if (const auto section = from.optional_section("adaptive")) {
    mission.adaptive = read_adaptive(*section, places);
    if (from.good()) mission.steps = steps_of({first_line(*mission.adaptive)});
  }
  for (auto& step : from.list("steps")) mission.steps.push_back(read_step(step, places));
  return int{from.has("runlines")} + int{from.has("lawnmower")} + int{from.has("auto")} + int{from.has("adaptive")} +
         int{from.has("steps")};
}

/// Where a mission has lines there must be one to start at; where it has none, the vehicle needs a start.
std::vector<runlines::Runline> straight_pieces(const std::vector<MissionStep>& steps) {
  std::vector<runlines::Runline> pieces;
  for (const MissionStep& step : steps) {
    const auto* line = std::get_if<FollowLine>(&step);
    for (std::size_t i = 1; line != nullptr && i < line->points_enu_m.size(); ++i) {
      pieces.push_back({line->points_enu_m[i - 1], line->points_enu_m[i]});
    }
  }
  return pieces;
}

/// An altitude below the obstacle floor is never run, and without a floor nothing is ever below it.
void check_altitudes(const ConfigReader& from, const Mission& mission) {
  const auto fault = [&](double altitude_m) {
    return fmt::format("altitude_m {} is below least_altitude_m {}; allowed: that or more", altitude_m,
                       mission.least_altitude_m);
  };
  if (mission.abort.too_low_s && mission.least_altitude_m <= 0.0)
    from.problem("abort", "too_low_s needs an obstacle floor; allowed: with a least_altitude_m above 0");
  if (mission.altitude_m && *mission.altitude_m < mission.least_altitude_m)
    from.problem("", fault(*mission.altitude_m));
  for (std::size_t i = 0; i < mission.steps.size(); ++i) {
    const auto* go = std::get_if<GoAt>(&mission.steps[i]);
    if (go != nullptr && go->altitude_m && *go->altitude_m < mission.least_altitude_m) {
      from.problem("", fmt::format("step {}: {}", i + 1, fault(*go->altitude_m)));
    }
  }
}

ParameterInfo place_info(const std::string& key, const std::string& about, bool required = true) {
  return numbers_info(key, about + ", as positions says", 2, required);
}

ParameterList with(ParameterInfo first, ParameterList rest) {
  rest.insert(rest.begin(), std::move(first));
  return rest;
}

/// What a step can be. Which keys belong to each other is told by the step's own key.
ParameterList step_list() {
  ParameterList stay = parameters_of<Stay>(), wait = parameters_of<Wait>();
  stay.push_back(parameters_of<KeepPlace>().front());
  wait.push_back(parameters_of<KeepPlace>().front());
  const std::vector<std::pair<const char*, ParameterList>> forms = {
      {"line", {rows_info("line", "two places or more, run through with run-in and run-out", 2, true)}},
      {"pass", with(place_info("pass", "a place that is passed through"), parameters_of<PassPlace>())},
      {"keep", with(place_info("keep", "a place to stop and stay at"), stay)},
      {"wait_s", wait},
      {"orbit", with(place_info("orbit", "centre of a circle"), parameters_of<FollowOrbit>())},
      {"set_sonar", parameters_of<SetSonar>()},
      {"mark", parameters_of<SetMark>()},
      {"", parameters_of<GoAt>()}};
  ParameterList either;
  for (const auto& [key, form] : forms) either.push_back(section_info(key, "", form));
  return either;
}

}  // namespace

ParameterList mission_list() {
  ParameterList list = parameters_of<Positions>();
  for (ParameterInfo& info : parameters_of<Mission>()) list.push_back(std::move(info));
  list.push_back(file_info("file", "a mission of its own, mission/1; what stands beside it counts", false));
  list.push_back(list_info("runlines", "straight lines in their order",
                           {place_info("from_m", "start of the line"), place_info("to_m", "end of the line")}));
  list.push_back(section_info(
      "lawnmower", "parallel lines, to and fro",
      with(place_info("centre_m", "middle of all lines; left out: the origin", false), parameters_of<Lawnmower>())));
  list.push_back(section_info("adaptive", "parallel lines over a rectangle, each laid where the coverage so far ends",
                              with(place_info("centre_m", "middle of the rectangle"), parameters_of<AdaptivePlan>())));
  list.push_back(forms_info("steps", "what is done, in order", step_list()));
  return list;
}

std::vector<MissionStep> steps_of(const std::vector<runlines::Runline>& lines) {
  std::vector<MissionStep> steps;
  for (const auto& line : lines) steps.push_back(FollowLine{{line.start_enu_m, line.end_enu_m}});
  return steps;
}

runlines::Runline first_line(const AdaptivePlan& plan) {
  const Vec2 forward(std::sin(plan.heading_rad), std::cos(plan.heading_rad)), starboard(forward.y(), -forward.x());
  const Vec2 middle = plan.centre_enu_m + (plan.first_line_m - 0.5 * plan.width_m) * starboard;
  return {middle - 0.5 * plan.length_m * forward, middle + 0.5 * plan.length_m * forward};
}

std::optional<double> depth_after(const GoAt& order, std::optional<double> before_m) {
  if (order.altitude_m) return std::nullopt;
  return order.depth_m ? order.depth_m : before_m;
}

std::vector<std::optional<double>> Mission::runline_depths_m() const {
  std::vector<std::optional<double>> depths;
  std::optional<double> now_m = altitude_m ? std::nullopt : std::optional(depth_m);
  for (const MissionStep& step : steps) {
    if (const auto* go = std::get_if<GoAt>(&step)) now_m = depth_after(*go, now_m);
    if (const auto* line = std::get_if<FollowLine>(&step))
      depths.insert(depths.end(), line->points_enu_m.size() - 1, now_m);
  }
  return depths;
}

std::vector<std::string> Mission::sonars() const {
  std::vector<std::string> heads;
  for (const MissionStep& step : steps) {
    const auto* sonar = std::get_if<SetSonar>(&step);
    if (sonar != nullptr && std::find(heads.begin(), heads.end(), sonar->head) == heads.end()) {
      heads.push_back(sonar->head);
    }
  }
  return heads;
}

Mission read_mission(ConfigReader from, const std::optional<frames::Geodetic>& origin) {
  Mission mission;
  int plans = 0;
  std::string path;
  from.optional_path("file", path);
  if (!path.empty()) {
    ConfigReader file = from.also(parse_config_file(path));
    read_format(file, kMissionFormat);
    plans += read_keys(file, origin, mission);
  }
  plans += read_keys(from, origin, mission);
  if (plans != 1) {
    from.problem("", std::string(plans == 0 ? "has no plan" : "has several plans") +
                         "; give one of runlines, lawnmower, auto, adaptive, steps");
  }
  mission.runlines = straight_pieces(mission.steps);
  check_altitudes(from, mission);
  return mission;
}

namespace {

/// What of a mission a vehicle is too fast, too slow to turn or too light for.
class VehicleCheck {
 public:
  VehicleCheck(const ConfigReader& from, const std::string& vehicle, double fastest_mps, const motion::Limits& limits)
      : from_(from), vehicle_(vehicle), fastest_mps_(fastest_mps), limits_(limits) {}

  void check(const Mission& mission) const {
    if (mission.speed_mps > fastest_mps_)
      from_.problem("mission", "speed_mps is above what " + vehicle_ + " can do (fastest_mps)");
    if (const double circle_m = circle(mission.speed_mps); circle_m > kWidestTurn_m) {
      from_.problem("vehicles", fmt::format("{}: turn_rate_dps makes it turn on a radius of {:.0f} m at {} m/s; "
                                            "allowed: {:.0f} m or less",
                                            vehicle_, circle_m, mission.speed_mps, kWidestTurn_m));
    }
    double speed_mps = mission.speed_mps;
    for (std::size_t i = 0; i < mission.steps.size(); ++i) {
      if (const auto* go = std::get_if<GoAt>(&mission.steps[i]); go != nullptr && go->speed_mps) {
        speed_mps = *go->speed_mps;
        check_speed(i, speed_mps);
      }
    }
    check_orbits(mission, mission.speed_mps);
    if (mission.repeat > 1 && speed_mps != mission.speed_mps) check_orbits(mission, speed_mps);
  }

 private:
  double circle(double speed_mps) const { return motion::turning_circle_m(speed_mps, limits_); }
  void problem(std::size_t step, const std::string& what) const {
    from_.problem("mission", fmt::format("step {}: {}", step + 1, what));
  }

  void check_speed(std::size_t step, double speed_mps) const {
    if (speed_mps > fastest_mps_) problem(step, "speed_mps is above what " + vehicle_ + " can do (fastest_mps)");
    if (circle(speed_mps) > kWidestTurn_m) {
      problem(step,
              fmt::format("at speed_mps {} turn_rate_dps makes {} turn on a radius of {:.0f} m; allowed: {:.0f} m "
                          "or less",
                          speed_mps, vehicle_, circle(speed_mps), kWidestTurn_m));
    }
  }

  /// Of a round that begins at a speed.
  void check_orbits(const Mission& mission, double speed_mps) const {
    for (std::size_t i = 0; i < mission.steps.size(); ++i) {
      if (const auto* go = std::get_if<GoAt>(&mission.steps[i])) speed_mps = go->speed_mps.value_or(speed_mps);
      const auto* orbit = std::get_if<FollowOrbit>(&mission.steps[i]);
      if (orbit == nullptr || orbit->radius_m >= circle(speed_mps)) continue;
      problem(i, fmt::format("radius_m {} is less than {} can turn at {} m/s; allowed: {} m or more", orbit->radius_m,
                             vehicle_, speed_mps, circle(speed_mps)));
    }
  }

  const ConfigReader& from_;
  const std::string& vehicle_;
  double fastest_mps_;
  const motion::Limits& limits_;
};

}  // namespace

void check_mission(const ConfigReader& from, const Mission& mission, const std::string& vehicle, double fastest_mps,
                   const motion::Limits& limits, bool floats) {
  VehicleCheck(from, vehicle, fastest_mps, limits).check(mission);
  const bool dives = mission.altitude_m || std::ranges::any_of(mission.steps, [](const MissionStep& step) {
                       const auto* go = std::get_if<GoAt>(&step);
                       return go != nullptr && (go->depth_m || go->altitude_m);
                     });
  if (dives && floats)
    from.problem("mission", "altitude_m and depth_m of steps need a vehicle that dives; " + vehicle + " floats");
}

}  // namespace ensonify
