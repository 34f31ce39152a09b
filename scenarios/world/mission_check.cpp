// What of a mission the world and its vehicle do not allow, before anything runs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenarios/world/world.h"

namespace ensonify {

namespace {

constexpr double kWidestTurn_m = 1000.0;  // as turning_radius_m has: the largest ships need some hundred metres

/// Way along each of two straight pieces that a turn between them takes, on a circle that touches both.
double bend_m(const runlines::Vec2& before, const runlines::Vec2& after, double radius_m) {
  const double cosine = before.normalized().dot(after.normalized());
  const double half_turn_rad = 0.5 * std::acos(std::clamp(cosine, -1.0, 1.0));
  return radius_m * std::tan(half_turn_rad);
}

/// Way made good per second along a direction by a vehicle that stays on it; 0: it is set off it, or back.
double headway_mps(double speed_mps, const frames::Vec2& current, const frames::Vec2& along) {
  const double set_mps = along.x() * current.y() - along.y() * current.x();
  if (std::abs(set_mps) >= speed_mps) return 0.0;
  return std::max(0.0, std::sqrt(speed_mps * speed_mps - set_mps * set_mps) + along.dot(current));
}

/// The most headway at any time: of the tide's streams, every ten minutes of two days (spring and neap differ by less
/// than what a mission needs to spare).
double best_headway_mps(double speed_mps, const motion::Current& current, double depth_m, const frames::Vec2& along) {
  constexpr double kStep_s = 600.0, kTwoDays_s = 172'800.0;
  double best_mps = headway_mps(speed_mps, current.velocity_enu_mps(depth_m, 0.0), along);
  for (double t_s = kStep_s; !current.streams.empty() && t_s < kTwoDays_s; t_s += kStep_s) {
    best_mps = std::max(best_mps, headway_mps(speed_mps, current.velocity_enu_mps(depth_m, t_s), along));
  }
  return best_mps;
}

/// What of a mission a vehicle is too fast, too slow to turn, too weak or too light for.
class VehicleCheck {
 public:
  VehicleCheck(const ConfigReader& from, const Vehicle& vehicle, const motion::Current& current)
      : from_(from),
        vehicle_(vehicle.name),
        fastest_mps_(vehicle.fastest_mps),
        limits_(vehicle.limits),
        current_(current) {}

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
    check_lines(mission);
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

  /// Of the first round.
  void check_lines(const Mission& mission) const {
    double speed_mps = mission.speed_mps;
    std::optional<double> depth_m = mission.altitude_m ? std::nullopt : std::optional(mission.depth_m);
    for (std::size_t i = 0; i < mission.steps.size(); ++i) {
      if (const auto* go = std::get_if<GoAt>(&mission.steps[i])) {
        speed_mps = go->speed_mps.value_or(speed_mps);
        depth_m = depth_after(*go, depth_m);
      }
      if (const auto* line = std::get_if<FollowLine>(&mission.steps[i])) {
        check_bends(i, line->points_enu_m, speed_mps);
        // Where the bottom is followed nobody knows at which depth of a sheared current.
        if (depth_m || !current_.sheared()) check_headway(i, line->points_enu_m, speed_mps, depth_m.value_or(0.0));
      }
    }
  }

  void check_bends(std::size_t step, const std::vector<runlines::Vec2>& points, double speed_mps) const {
    double before_m = 0.0;  // of a piece, what the bend at its beginning takes
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const runlines::Vec2 piece = points[i + 1] - points[i];
      const double after_m =
          i + 2 < points.size() ? bend_m(piece, points[i + 2] - points[i + 1], circle(speed_mps)) : 0.0;
      if (before_m + after_m > piece.norm()) {
        return problem(step,
                       fmt::format("line: the {:.0f} m from place {} to {} are too short for the bends of {}, which "
                                   "turns on a radius of {:.3g} m at {} m/s; allowed: longer pieces, blunter "
                                   "bends, or a line for each",
                                   piece.norm(), i + 1, i + 2, vehicle_, circle(speed_mps), speed_mps));
      }
      before_m = after_m;
    }
  }

  void check_headway(std::size_t step, const std::vector<runlines::Vec2>& points, double speed_mps,
                     double depth_m) const {
    if (current_.none()) return;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const frames::Vec2 along = (points[i + 1] - points[i]).normalized();
      if (best_headway_mps(speed_mps, current_, depth_m, along) > 0.0) continue;
      return problem(step,
                     fmt::format("line: {} makes no way from place {} to {} at {} m/s through the water: the current "
                                 "there is {:.3g} m/s; allowed: a faster vehicle or a weaker current",
                                 vehicle_, i + 1, i + 2, speed_mps, current_.velocity_enu_mps(depth_m, 0.0).norm()));
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
  const motion::Current& current_;
};

}  // namespace

void check_mission(const ConfigReader& from, const Mission& mission, const Vehicle& vehicle,
                   const motion::Current& current) {
  VehicleCheck(from, vehicle, current).check(mission);
  const bool dives = mission.altitude_m || std::ranges::any_of(mission.steps, [](const MissionStep& step) {
                       const auto* go = std::get_if<GoAt>(&step);
                       return go != nullptr && (go->depth_m || go->altitude_m);
                     });
  if (dives && vehicle.floats)
    from.problem("mission", "altitude_m and depth_m of steps need a vehicle that dives; " + vehicle.name + " floats");
}

void check_heads(const ConfigReader& from, const Mission& mission, const Vehicle& vehicle) {
  std::optional<double> depth_m = mission.altitude_m ? std::nullopt : std::optional(mission.depth_m);
  double deepest_m = depth_m.value_or(0.0);
  if (vehicle.start) deepest_m = std::max(deepest_m, -vehicle.start->position_enu_m.z());
  bool known = depth_m.has_value();  // nobody knows how deep the bottom is
  for (const MissionStep& step : mission.steps) {
    const auto* go = std::get_if<GoAt>(&step);
    if (go == nullptr) continue;
    depth_m = depth_after(*go, depth_m);
    known = known && depth_m;
    deepest_m = std::max(deepest_m, depth_m.value_or(0.0));
  }
  if (!known) return;
  if (vehicle.floats) deepest_m += std::max(0.0, sinkage_m(*vehicle.floats, mission.speed_mps, 0.0));
  for (const auto& [head, mounting] : vehicle.mountings) {
    const double above_m = -mounting.actual.position_body_m.z() - deepest_m;
    if (above_m <= 0.0) continue;
    from.problem("vehicles", fmt::format("{}.mountings.{}: the head is {:.3g} m above the water where {} is deepest; "
                                         "allowed: a position_m farther down (its third number)",
                                         vehicle.name, head, above_m, vehicle.name));
  }
}

}  // namespace ensonify
