#include "kernels/water/refraction/eigenray.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <string>

namespace ensonify::refraction {
namespace {

constexpr double kVertical_rad = std::numbers::pi / 2;
constexpr int kSteps = 220;  // a fourth of them halve a bracket of pi, to the last bit

/// A path with the count of its turns.
struct TracedPath {
  Path path;
  int turns = 0;
  double turning_depth_m = 0.0;

  void take(const Leg& leg) {
    if (leg.turns) {
      ++turns;
      turning_depth_m = path.turning_depth_m();
    }
    path.take(leg);
  }

  PathEnd end() const {
    const PathPoint& at = path.at();
    return {.horizontal_m = path.horizontal_m(),
            .depth_m = at.depth_m,
            .depression_rad = std::atan2(at.sine, at.cosine),
            .travel_time_s = at.time_s,
            .path_length_m = at.length_m,
            .tube_m2 = path.tube_m2(),
            .horizontal_per_rad_m = at.width_m == 0.0 ? 0.0 : -at.width_m / at.sine,
            .turns = turns,
            .turning_depth_m = turning_depth_m};
  }
};

TracedPath start(const SoundSpeedProfile& profile, double source_depth_m, double depression_rad) {
  if (!std::isfinite(source_depth_m)) throw std::invalid_argument("the depth of a path's source must be finite");
  if (!(std::abs(depression_rad) <= kVertical_rad)) {
    throw std::invalid_argument("the depression of a launch must lie in -90..90 degrees");
  }
  const bool vertical = std::abs(depression_rad) == kVertical_rad;  // whose cosine is not quite 0 in floating point
  return {Path(profile, source_depth_m, std::sin(depression_rad), vertical ? 0.0 : std::cos(depression_rad))};
}

void check_length(double value, const char* what) {
  if (!(value >= 0.0 && std::isfinite(value))) {
    throw std::invalid_argument(std::string("the ") + what + " of a path must be finite and not negative");
  }
}

/// Takes whole legs while measure(leg) fits into `left`, then the leg that uses the rest up.
template <class Measure, class Last>
void go(TracedPath& traced, double left, Measure measure, Last last) {
  while (left > 0.0) {
    const Leg whole = traced.path.leg_within();
    const double size = whole.endless() ? left : measure(whole);
    if (size >= left) return traced.take(last(left));
    left -= size;
    traced.take(whole);
  }
}

TracedPath over(const SoundSpeedProfile& profile, double source_depth_m, double depression_rad, double horizontal_m) {
  TracedPath traced = start(profile, source_depth_m, depression_rad);
  go(
      traced, horizontal_m, [](const Leg& leg) { return leg.chord_m * leg.chord_cosine; },
      [&](double left) { return traced.path.leg_of_horizontal(left); });
  return traced;
}

}  // namespace

std::optional<PathEnd> path_to_depth(const SoundSpeedProfile& profile, double source_depth_m, double depression_rad,
                                     double target_depth_m, int max_turns) {
  return path_to_depth(start(profile, source_depth_m, depression_rad).path, target_depth_m, max_turns);
}

std::optional<PathEnd> path_to_depth(const Path& from, double target_depth_m, int max_turns) {
  if (!std::isfinite(target_depth_m)) throw std::invalid_argument("the target depth of a path must be finite");
  TracedPath traced{from};
  const Path& path = traced.path;
  if (path.at().length_m > 0.0 && path.at().depth_m == target_depth_m) return traced.end();
  do {
    const double depth = path.at().depth_m;
    const bool target_below = depth < target_depth_m || (depth == target_depth_m && !path.heads_down());
    const Leg leg = target_below ? path.leg_within(-std::numeric_limits<double>::infinity(), target_depth_m)
                                 : path.leg_within(target_depth_m);
    if (leg.endless() || traced.turns + (leg.turns ? 1 : 0) > max_turns) return std::nullopt;
    traced.take(leg);
  } while (path.at().depth_m != target_depth_m);
  return traced.end();
}

PathEnd path_at_time(const SoundSpeedProfile& profile, double source_depth_m, double depression_rad, double time_s) {
  check_length(time_s, "travel time");
  TracedPath traced = start(profile, source_depth_m, depression_rad);
  go(
      traced, time_s, [&](const Leg& leg) { return traced.path.time_of(leg); },
      [&](double left) { return traced.path.leg_of_time(left); });
  return traced.end();
}

PathEnd path_at_horizontal(const SoundSpeedProfile& profile, double source_depth_m, double depression_rad,
                           double horizontal_m) {
  check_length(horizontal_m, "horizontal distance");
  if (!(std::abs(depression_rad) < kVertical_rad)) {
    throw std::invalid_argument("a vertical path does not reach a horizontal distance");
  }
  return over(profile, source_depth_m, depression_rad, horizontal_m).end();
}

std::optional<Eigenray> eigenray(const SoundSpeedProfile& profile, double source_depth_m, double horizontal_m,
                                 double target_depth_m) {
  check_length(horizontal_m, "horizontal distance");
  if (!std::isfinite(target_depth_m)) throw std::invalid_argument("the target depth of a path must be finite");
  const double drop = target_depth_m - source_depth_m, distance = std::hypot(horizontal_m, drop);
  const double close_enough = std::max(1e-6, 1e-9 * distance);
  if (distance <= close_enough) return Eigenray{0.0, start(profile, source_depth_m, 0.0).end()};
  if (horizontal_m <= close_enough) {
    const double launch = std::copysign(kVertical_rad, drop);
    return Eigenray{launch, path_to_depth(profile, source_depth_m, launch, target_depth_m).value()};
  }

  double low = -kVertical_rad, high = kVertical_rad, launch = std::atan2(drop, horizontal_m);
  for (int step = 0; step < kSteps; ++step) {
    const TracedPath traced = over(profile, source_depth_m, launch, horizontal_m);
    const PathPoint& at = traced.path.at();
    const double miss = (target_depth_m - at.depth_m) * at.cosine;  // across the path
    if (std::abs(miss) <= close_enough) return Eigenray{launch, traced.end()};
    (miss > 0.0 ? low : high) = launch;
    launch += miss / at.width_m;
    if (step % 4 == 3 || !(launch > low && launch < high)) launch = 0.5 * (low + high);
  }
  return std::nullopt;  // the bracket has closed over a jump
}

}  // namespace ensonify::refraction
