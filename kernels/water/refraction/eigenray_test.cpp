#include "kernels/water/refraction/eigenray.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "kernels/water/refraction/thermocline.h"

using namespace ensonify::refraction;
using Catch::Matchers::WithinAbs;
constexpr double kDeg = std::numbers::pi / 180;

/// Straight pieces through thin layers of constant speed, that of their middle: knows Snell's law and nothing of arcs.
static PathEnd staircase(const SoundSpeedProfile& profile, double from_m, double depression_rad, double to_m,
                         int steps) {
  const double p = std::cos(depression_rad) / profile.speed_mps(from_m), dz = (to_m - from_m) / steps;
  PathEnd end;
  for (int i = 0; i < steps; ++i) {
    const double c = profile.speed_mps(from_m + (i + 0.5) * dz), sine = std::sqrt(1 - p * c * p * c);
    end.horizontal_m += dz * p * c / sine;
    end.path_length_m += dz / sine;
    end.travel_time_s += dz / (sine * c);
  }
  return end;
}

TEST_CASE("paths through a thermocline are the limit of thin layers") {
  const auto profile = summer_thermocline();
  for (const double degrees : {10.0, 15.0, 30.0, 60.0, 85.0}) {
    // 16,000 steps of 5 mm, so that knots lie between steps; the rule's error falls with the square of the step.
    const PathEnd limit = staircase(profile, 0, degrees * kDeg, 80, 16'000);
    const auto exact = path_to_depth(profile, 0, degrees * kDeg, 80);
    REQUIRE(exact);
    CHECK(exact->horizontal_m == Approx(limit.horizontal_m).epsilon(1e-9));
    CHECK(exact->path_length_m == Approx(limit.path_length_m).epsilon(1e-9));
    CHECK(exact->travel_time_s == Approx(limit.travel_time_s).epsilon(1e-9));
    CHECK(exact->turns == 0);
  }
}

TEST_CASE("a path is refused or missing, never NaN") {
  const auto profile = summer_thermocline();
  CHECK_THROWS_WITH(path_to_depth(profile, 0, 1.6, 10), "the depression of a launch must lie in -90..90 degrees");
  CHECK_THROWS_WITH(path_to_depth(profile, std::nan(""), 1, 10), "the depth of a path's source must be finite");
  CHECK_THROWS_WITH(path_at_time(profile, 0, 1, -1), "the travel time of a path must be finite and not negative");
  CHECK_THROWS_WITH(path_at_horizontal(profile, 0, std::numbers::pi / 2, 1),
                    "a vertical path does not reach a horizontal distance");
  CHECK_FALSE(path_to_depth(profile, 10, 0.5, 5));         // goes down for good
  CHECK_FALSE(path_to_depth(profile, 10, -0.5, 50));       // goes up for good
  CHECK_FALSE(path_to_depth(profile, 50, -2 * kDeg, 80));  // turns above
  CHECK(path_to_depth(profile, 50, -2 * kDeg, 80, 1));     // and comes back
}

TEST_CASE("a path that turns comes back to its depth at the opposite angle") {
  const double g = -1.2;  // a thermocline
  const SoundSpeedProfile profile({{0, 1530}, {50, 1470}});
  const double c0 = 1494, angle = -6 * kDeg, p = std::cos(angle) / c0;
  const auto end = path_to_depth(profile, 30, angle, 30, 1);
  REQUIRE(end);
  CHECK(end->depression_rad == Approx(-angle));
  CHECK(end->turns == 1);
  CHECK(end->turning_depth_m == Approx((1 / p - 1530) / g));
  CHECK(end->horizontal_m == Approx(2 * std::sin(-angle) / (p * -g)));
  CHECK(end->travel_time_s == Approx(2 / -g * std::atanh(std::sin(-angle))));
  // x = 2 c0 tan(angle) / |g|, so dx/dangle = -2 c0 / (|g| cos^2), negative: lower launches come back sooner.
  CHECK(end->horizontal_per_rad_m == Approx(-2 * c0 / (-g * std::pow(std::cos(angle), 2))));
}

TEST_CASE("the bundle's width is the derivative of the path") {
  const auto profile = summer_thermocline();
  const double h = 1e-6;
  const auto at = [&](double source, double angle, double depth) {
    return path_to_depth(profile, source, angle, depth, 1)->horizontal_m;
  };
  for (const auto& [source, degrees, depth] : {std::tuple{0.0, 15.0, 80.0},
                                               {3.0, 40.0, 71.0},
                                               {0.0, 89.0, 80.0},
                                               {50.0, -2.0, 70.0},
                                               {35.0, -3.5, 35.0}}) {  // the last two turn
    const double angle = degrees * kDeg;
    const auto end = path_to_depth(profile, source, angle, depth, 1);
    const double slope = (at(source, angle + h, depth) - at(source, angle - h, depth)) / (2 * h);
    CHECK(end->horizontal_per_rad_m == Approx(slope).epsilon(1e-6));
    // The tube in the form of Bellhop's loss: x |dx/dtheta| sin(end) / cos(launch).
    CHECK(end->tube_m2 ==
          Approx(end->horizontal_m * std::abs(slope) * std::abs(std::sin(end->depression_rad)) / std::cos(angle))
              .epsilon(1e-6));
  }
}

TEST_CASE("at a caustic the bundle is kept open") {
  // Above a fall of speed, rays launched up at steeper angles turn higher and come down farther or nearer: between lies
  // a caustic, where d(horizontal)/d(angle) changes sign.
  const auto profile = summer_thermocline();
  double smallest = 1;
  bool positive = false, negative = false;
  for (double degrees = -9; degrees < -0.5; degrees += 0.01) {
    const auto end = path_to_depth(profile, 35, degrees * kDeg, 60, 1);
    if (!end) continue;
    REQUIRE(std::isfinite(end->tube_m2));
    (end->horizontal_per_rad_m > 0 ? positive : negative) = true;
    smallest = std::min(smallest, end->tube_m2 / (end->path_length_m * end->path_length_m));
  }
  CHECK((positive && negative));
  CHECK(smallest == Approx(Path::kTubeFloor));
}

TEST_CASE("there and back: the same time, and bundles in the ratio of the speeds squared") {
  const auto profile = summer_thermocline();
  for (const auto& [from, across, to] :
       {std::tuple{1.0, 30.0, 78.0}, {1.0, 290.0, 78.0}, {14.0, 120.0, 14.5}, {40.0, 200.0, 60.0}, {5.0, 0.0, 50.0}}) {
    const Eigenray there = eigenray(profile, from, across, to).value();
    const Eigenray back = eigenray(profile, to, across, from).value();
    CHECK_THAT(there.end.depth_m, WithinAbs(to, 2e-6 / std::cos(std::min(std::abs(there.end.depression_rad), 1.5))));
    CHECK_THAT(there.end.horizontal_m, WithinAbs(across, 1e-9));
    CHECK(there.end.travel_time_s == Approx(back.end.travel_time_s).epsilon(1e-8));
    CHECK_THAT(there.end.depression_rad, WithinAbs(-back.launch_depression_rad, 1e-7));
    const double c1 = profile.speed_mps(from), c2 = profile.speed_mps(to);
    CHECK(there.end.tube_m2 * c1 * c1 == Approx(back.end.tube_m2 * c2 * c2).epsilon(1e-6));
  }
}

TEST_CASE("an eigenray is found for every point around the source, unless it lies in shadow") {
  const SoundSpeedProfile wild({{0, 1530}, {5, 1500}, {6, 1520}, {20, 1480}, {40, 1510}, {41, 1470}});
  int shadows = 0;
  for (const double source : {2.0, 6.0, 30.0}) {
    for (const double across : {1e-7, 0.01, 1.0, 10.0, 60.0, 150.0}) {
      for (double depth = -10; depth <= 60; depth += 3.7) {
        const auto ray = eigenray(wild, source, across, depth);
        shadows += !ray;
        if (ray) REQUIRE(std::abs((ray->end.depth_m - depth) * std::cos(ray->end.depression_rad)) < 2e-6);
        if (across <= 10 && std::abs(depth - source) > 1) REQUIRE(ray);
      }
    }
  }
  CHECK(shadows < 0.1 * 3 * 6 * 19);
  // On a ridge of speed all paths part, up or down, and none goes on level.
  CHECK_FALSE(eigenray(wild, 6, 60, 6.2));
  CHECK(eigenray(wild, 6, 0, 6)->end.travel_time_s == 0);
}

TEST_CASE("the first arrival is the fastest, and time along it is stationary") {
  // Fermat: through a point beside the path the sum of times is longer, by the square of the offset.
  const auto profile = summer_thermocline();
  const Eigenray direct = eigenray(profile, 2, 150, 75).value();
  const PathEnd middle = path_at_time(profile, 2, direct.launch_depression_rad, 0.5 * direct.end.travel_time_s);
  for (const double off : {-0.5, 0.5}) {
    const double by_way_of = eigenray(profile, 2, middle.horizontal_m, middle.depth_m + off)->end.travel_time_s +
                             eigenray(profile, middle.depth_m + off, 150 - middle.horizontal_m, 75)->end.travel_time_s;
    CHECK(by_way_of > direct.end.travel_time_s);
    CHECK(by_way_of - direct.end.travel_time_s < 4e-6);
  }
}
