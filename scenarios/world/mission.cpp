#include "scenarios/world/mission.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/config/parse_yaml.h"
#include "components/config/read_parameters.h"
#include "components/errors/assert.h"
#include "scenarios/world/mission_keys.h"
#include "scenarios/world/world.h"

namespace ensonify {
namespace {

using runlines::Vec2;

constexpr std::size_t kLongestName = 200;  // of a line: it goes into every mission_state/1

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

  void place(const std::string& key, Vec2& found) const {
    if (!projection_) return;
    const double off_m = distance_m(found[0], found[1]);
    if (off_m <= kFarAway_m) {
      found = projection_->enu_of({found[0], found[1]});
      return;
    }
    const bool swapped = distance_m(found[1], found[0]) < kFarAway_m;
    from_.problem(key, fmt::format("[{}, {}] is {} from the site's origin; allowed: 100 km{}", found[0], found[1],
                                   std::isfinite(off_m) ? fmt::format("{:.0f} km", 1e-3 * off_m) : "not a place",
                                   swapped ? "; are latitude and longitude swapped?" : ""));
    found = Vec2::Zero();
  }

  // `at` is the step's own place, "steps[3]."
  void place(const std::string& at, FollowLine& line) const {
    for (Vec2& point : line.points_enu_m) place(at + "line", point);
    if (line.name.size() > kLongestName) {
      from_.problem(at + "name", fmt::format("has {} bytes; allowed: {}", line.name.size(), kLongestName));
    }
    if (!from_.good()) return;
    if (line.points_enu_m.size() < 2) from_.problem(at + "line", "has fewer than 2 places");
    for (std::size_t i = 1; i < line.points_enu_m.size(); ++i) {
      if ((line.points_enu_m[i] - line.points_enu_m[i - 1]).norm() < kShortest_m) {
        from_.problem(at + "line", fmt::format("place {} is less than 1 m from the one before", i + 1));
      }
    }
  }
  void place(const std::string& at, PassPlace& pass) const { place(at + "pass", pass.place_enu_m); }
  void place(const std::string& at, KeepPlace& keep) const {
    if (keep.place_enu_m) place(at + "keep", *keep.place_enu_m);
  }
  void place(const std::string& at, FollowOrbit& orbit) const { place(at + "orbit", orbit.centre_enu_m); }
  void place(const std::string&, auto&) const {}

  bool good() const { return from_.good(); }
  void problem(const std::string& key, const std::string& message) const { from_.problem(key, message); }

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

// Steps and plans, each with its places in metres.

void lay(const RunlinesPlan& plan, const Places& places, Mission& mission) {
  std::vector<runlines::Runline> lines;
  for (std::size_t i = 0; i < plan.runlines.size(); ++i) {
    RunlineKeys line = plan.runlines[i];
    const std::string key = fmt::format("runlines[{}].", i);
    places.place(key + "from_m", line.from);
    places.place(key + "to_m", line.to);
    lines.push_back({line.from, line.to});
    if (places.good() && runlines::length_m(lines.back()) < kShortest_m)
      places.problem(key + "to_m", "is less than 1 m from from_m");
  }
  mission.steps = steps_of(lines);
}
void lay(const LawnmowerPlan& plan, const Places& places, Mission& mission) {
  const LawnmowerKeys& rows = plan.lawnmower;
  Vec2 centre = rows.centre.value_or(Vec2(0, 0));
  if (rows.centre) places.place("lawnmower.centre_m", centre);
  if (places.good())
    mission.steps = steps_of(runlines::lawnmower(centre, rows.heading_rad, rows.length_m, rows.spacing_m, rows.count));
}
void lay(const PlanOfRaster& plan, const Places&, Mission& mission) { mission.auto_plan = plan.plan; }
void lay(PlanOfCoverage plan, const Places& places, Mission& mission) {
  places.place("adaptive.centre_m", plan.plan.centre_enu_m);
  if (places.good()) mission.steps = steps_of({first_line(plan.plan)});
  mission.adaptive = plan.plan;
}
void lay(const PlanOfTrack& plan, const Places&, Mission& mission) { mission.follow = plan.plan; }
void lay(const StepsPlan& plan, const Places& places, Mission& mission) {
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    MissionStep& step = mission.steps.emplace_back(plan.steps[i]);
    std::visit([&](auto& read) { places.place(fmt::format("steps[{}].", i), read); }, step);
  }
}
void lay(const NoPlan&, const Places&, Mission&) {}

int plans_in(const ConfigReader& from) {
  int plans = 0;
  for (const char* plan : {"runlines", "lawnmower", "auto", "adaptive", "follow", "steps"})
    plans += int{from.has(plan)};
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

void FollowTrack::check(const ConfigReader& from) const {
  if (from.good() && to_s && *to_s <= from_s)
    from.problem("to_s", fmt::format("{:g} is not after from_s {:g}; allowed: more", *to_s, from_s));
}

void FollowTrack::complete(ConfigReader& from) { here = from.problem_at("file", ""); }

void GoAt::check(const ConfigReader& from) const {
  if (depth_m && altitude_m) from.problem("altitude_m", "stands beside depth_m; give one or the other");
  if (!from.has("speed_mps") && !from.has("depth_m") && !from.has("altitude_m")) {
    from.problem("",
                 "is no step; allowed: line, pass, keep, wait_s, orbit, set_sonar, mark, or speed_mps with depth_m "
                 "or altitude_m");
  }
}

void SetSonar::complete(ConfigReader& from) {
  given["set_sonar"] = from.problem_at("set_sonar", "");
  for_settings(settings, [&](const char* name, const char* unit, auto&&...) {
    const std::string key = setting_in_file(name, unit).key;
    if (from.has(key)) given[name] = from.problem_at(key, "");
  });
}

void MissionKeys::read_base(ConfigReader& from) {
  if (!in_scenario) return;
  std::string found;
  from.optional_path("file", found);
  if (found.empty()) return;
  ConfigReader other = from.also(parse_config_file(found));
  read_format(other, kMissionFormat);
  in_scenario = false;
  read_parameters(other, *this);
  in_scenario = true;
}

void MissionKeys::complete(ConfigReader& from) {
  if (from.has("speed_kn") && from.has("speed_mps")) {
    from.problem("speed_kn", "stands beside speed_mps; give one or the other");
  }
  if (const int plans = plans_in(from); plans > 0) {
    plan_from_ = from;
    plans_ += plans;
    plan_geodetic_ = geodetic;
  }
  geodetic = plan_geodetic_;
  if (in_scenario) from_ = from;
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

Mission MissionKeys::mission(const std::optional<frames::Geodetic>& origin) const {
  ENSONIFY_ASSERT(from_, "a mission is read before it is laid out");
  const ConfigReader& from = *from_;
  Mission mission = values;
  if (plans_ != 1) {
    from.problem("", std::string(plans_ == 0 ? "has no plan" : "has several plans") +
                         "; give one of runlines, lawnmower, auto, adaptive, follow, steps");
  }
  const Places places(plan_from_ ? *plan_from_ : from, geodetic, origin);
  std::visit([&](const auto& form) { lay(form, places, mission); }, plan);
  if (mission.home_enu_m) places.place("home_m", *mission.home_enu_m);
  mission.runlines = straight_pieces(mission.steps);
  check_altitudes(from, mission);
  return mission;
}

}  // namespace ensonify
