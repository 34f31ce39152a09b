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

struct RunlineInFile {
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();

  static void parameters(auto& self, auto&& visit) {
    visit("from_m", "", must(place()), "start of the line, as positions says", self.from);
    visit("to_m", "", must(place()), "end of the line, as positions says", self.to);
  }
};

struct Lawnmower {
  std::optional<Vec2> centre;
  double heading_rad = 0.0, length_m = 0.0, spacing_m = 0.0;
  int count = 0;

  static void parameters(auto& self, auto&& visit) {
    visit("centre_m", "", place(), "middle of all lines, as positions says; left out: the origin", self.centre);
    visit("heading_deg", "deg", in(-360, 360), "of the first line", self.heading_rad);
    visit("length_m", "m", must(in(1, kFarAway_m)), "length of a line", self.length_m);
    visit("spacing_m", "m", must(in(0.1, kFarAway_m)), "from line to line", self.spacing_m);
    visit("count", "", must(in(1, 1000)), "number of lines", self.count);
  }
};

constexpr std::size_t kLongestName = 200;  // of a line: it goes into every mission_state/1

/// Kinds of steps, as they are before a file is read.
const std::vector<MissionStep>& kinds_of_step() {
  static const std::vector<MissionStep> kKinds = {FollowLine{},
                                                  PassPlace{Vec2::Zero(), {}},
                                                  KeepPlace{Vec2(0, 0)},
                                                  KeepPlace{},
                                                  FollowOrbit{Vec2::Zero()},
                                                  SetSonar{},
                                                  SetMark{},
                                                  GoAt{}};
  return kKinds;
}

ParameterList list_of(const MissionStep& kind) {
  return std::visit([](const auto& step) { return parameters_of(step); }, kind);
}

void note_places(const ConfigReader&, auto&) {}
void note_places(const ConfigReader& from, SetSonar& sonar) {
  sonar.given["set_sonar"] = from.problem_at("set_sonar", "");
  for_settings(sonar.settings, [&](const char* name, const char* unit, auto&&...) {
    const std::string key = setting_in_file(name, unit).key;
    if (from.has(key)) sonar.given[name] = from.problem_at(key, "");
  });
}

/// Steps with what they are read from, for problems that are found later.
struct Steps {
  std::vector<std::pair<ConfigReader, MissionStep>> all;

  void read(const ConfigReader& from, const char* key) {
    static const std::vector<std::string> kKeys = [] {
      std::vector<std::string> keys;
      for (const MissionStep& kind : kinds_of_step()) keys.push_back(list_of(kind).front().key);
      return keys;
    }();
    for (ConfigReader& item : from.list(key)) {
      std::size_t kind = 0;
      while (kind + 1 < kKeys.size() && !item.has(kKeys[kind])) ++kind;  // the last has no key of its own
      auto& [reader, step] = all.emplace_back(item, kinds_of_step()[kind]);
      std::visit(
          [&](auto& read) {
            read_parameters(item, read);
            note_places(item, read);
          },
          step);
    }
  }
  ConfigNode in_file() const { return detail::list_node(); }
  static std::string schema() {
    ParameterList forms;
    for (const MissionStep& kind : kinds_of_step()) forms.push_back(section_info("", "", list_of(kind)));
    return forms_info("", "", forms).schema;
  }
};

/// A mission's keys, its places not yet in metres.
struct MissionInFile {
  Mission mission;
  bool geodetic = false;
  std::vector<RunlineInFile> runlines;
  std::optional<Lawnmower> lawnmower;
  std::optional<AdaptivePlan> adaptive;
  Steps steps;

  static void parameters(auto& self, auto&& visit) {
    visit("positions", "", one_of({{"metres", false}, {"geodetic", true}}),
          "places are [east, north] from the site's origin, or [latitude, longitude] in degrees", self.geodetic);
    Mission::parameters(self.mission, visit);
    visit("runlines", "straight lines in their order", self.runlines);
    visit("lawnmower", "parallel lines, to and fro", self.lawnmower);
    visit("adaptive", "parallel lines over a rectangle, each laid where the coverage so far ends", self.adaptive);
    visit("steps", "", computed(any()), "what is done, in order", self.steps);
  }
};

/// Makes metres of places, in the frame that the mission says.
class Places {
 public:
  Places(const ConfigReader& from, bool geodetic, const std::optional<frames::Geodetic>& origin) : from_(from) {
    if (!geodetic) return;
    if (origin) {
      projection_.emplace(*origin);
    } else {
      from.problem("positions", "geodetic needs a site with latitude_deg and longitude_deg");
    }
  }

  void place(const std::string& key, Vec2& found) const { place(from_, key, found); }
  void place(const ConfigReader& from, const std::string& key, Vec2& found) const {
    if (!projection_) return;
    const double off_m = distance_m(found[0], found[1]);
    if (off_m <= kFarAway_m) {
      found = projection_->enu_of({found[0], found[1]});
      return;
    }
    const bool swapped = distance_m(found[1], found[0]) < kFarAway_m;
    from.problem(key, fmt::format("[{}, {}] is {} from the site's origin; allowed: 100 km{}", found[0], found[1],
                                  std::isfinite(off_m) ? fmt::format("{:.0f} km", 1e-3 * off_m) : "not a place",
                                  swapped ? "; are latitude and longitude swapped?" : ""));
    found = Vec2::Zero();
  }

  void place(const ConfigReader& from, FollowLine& line) const {
    for (Vec2& point : line.points_enu_m) place(from, "line", point);
    if (line.name.size() > kLongestName) {
      from.problem("name", fmt::format("has {} bytes; allowed: {}", line.name.size(), kLongestName));
    }
    if (!from.good()) return;
    if (line.points_enu_m.size() < 2) from.problem("line", "has fewer than 2 places");
    for (std::size_t i = 1; i < line.points_enu_m.size(); ++i) {
      if ((line.points_enu_m[i] - line.points_enu_m[i - 1]).norm() < kShortest_m) {
        from.problem("line", fmt::format("place {} is less than 1 m from the one before", i + 1));
      }
    }
  }
  void place(const ConfigReader& from, PassPlace& pass) const { place(from, "pass", pass.place_enu_m); }
  void place(const ConfigReader& from, KeepPlace& keep) const {
    if (keep.place_enu_m) place(from, "keep", *keep.place_enu_m);
  }
  void place(const ConfigReader& from, FollowOrbit& orbit) const { place(from, "orbit", orbit.centre_enu_m); }
  void place(const ConfigReader&, auto&) const {}

 private:
  /// Roughly, by the sphere: the projection is not made for other continents.
  double distance_m(double latitude_deg, double longitude_deg) const {
    if (std::abs(latitude_deg) > 90.0 || std::abs(longitude_deg) > 180.0) return INFINITY;
    const double r = kDegrees.si;
    const double a = latitude_deg * r, b = projection_->origin().latitude_deg * r;
    const double h = std::pow(std::sin(0.5 * (a - b)), 2) +
                     std::cos(a) * std::cos(b) *
                         std::pow(std::sin(0.5 * r * (longitude_deg - projection_->origin().longitude_deg)), 2);
    return 2.0 * 6371e3 * std::asin(std::min(1.0, std::sqrt(h)));
  }

  const ConfigReader& from_;
  std::optional<frames::LocalProjection> projection_;
};

std::vector<runlines::Runline> placed(const ConfigReader& from, std::vector<RunlineInFile> lines,
                                      const Places& places) {
  std::vector<runlines::Runline> runlines;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string key = fmt::format("runlines[{}].", i);
    places.place(key + "from_m", lines[i].from);
    places.place(key + "to_m", lines[i].to);
    runlines.push_back({lines[i].from, lines[i].to});
    if (from.good() && runlines::length_m(runlines.back()) < kShortest_m)
      from.problem(key + "to_m", "is less than 1 m from from_m");
  }
  return runlines;
}

/// The keys that a mission file and the section of a scenario share. Gives how many plans they hold.
int read_keys(ConfigReader& from, const std::optional<frames::Geodetic>& origin, Mission& mission) {
  if (from.has("speed_kn") && from.has("speed_mps")) {
    from.problem("speed_kn", "stands beside speed_mps; give one or the other");
  }
  MissionInFile file{mission};
  read_parameters(from, file);
  mission = std::move(file.mission);
  const Places places(from, file.geodetic, origin);
  if (from.has("runlines")) mission.steps = steps_of(placed(from, std::move(file.runlines), places));
  if (auto& rows = file.lawnmower; rows) {
    if (rows->centre) places.place("lawnmower.centre_m", *rows->centre);
    mission.steps.clear();
    if (from.good())
      mission.steps = steps_of(runlines::lawnmower(rows->centre.value_or(Vec2(0, 0)), rows->heading_rad, rows->length_m,
                                                   rows->spacing_m, rows->count));
  }
  if (file.adaptive) {
    places.place("adaptive.centre_m", file.adaptive->centre_enu_m);
    if (from.good()) mission.steps = steps_of({first_line(*file.adaptive)});
    mission.adaptive = std::move(file.adaptive);
  }
  for (auto& [reader, step] : file.steps.all) {
    std::visit([&, &reader = reader](auto& read) { places.place(reader, read); }, step);
    mission.steps.push_back(std::move(step));
  }
  int plans = 0;
  for (const char* plan : {"runlines", "lawnmower", "auto", "adaptive", "steps"}) plans += int{from.has(plan)};
  return plans;
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

}  // namespace

void AdaptivePlan::check(const ConfigReader& from) const {
  if (from.good() && first_line_m > width_m) from.problem("first_line_m", "lies beyond width_m");
  if (from.good() && length_m * width_m > 4e6 * cell_m * cell_m) {
    from.problem("cell_m", "makes more than 4 million cells; allowed: larger cells or a smaller rectangle");
  }
}

void GoAt::check(const ConfigReader& from) const {
  if (depth_m && altitude_m) from.problem("altitude_m", "stands beside depth_m; give one or the other");
  if (!from.has("speed_mps") && !from.has("depth_m") && !from.has("altitude_m")) {
    from.problem("",
                 "is no step; allowed: line, pass, keep, wait_s, orbit, set_sonar, mark, or speed_mps with depth_m "
                 "or altitude_m");
  }
}

ParameterList mission_list(bool in_scenario) {
  ParameterList list = parameters_of<MissionInFile>();
  if (in_scenario)
    list.push_back(file_info("file", "a mission of its own, mission/1; what stands beside it counts", false));
  return list;
}

ParameterList step_list() {
  ParameterList list;
  for (const MissionStep& kind : kinds_of_step())
    for (ParameterInfo& info : list_of(kind)) list.push_back(std::move(info));
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

}  // namespace ensonify
