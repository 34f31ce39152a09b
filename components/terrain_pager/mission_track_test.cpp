#include "components/terrain_pager/mission_track.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

using namespace ensonify;
using namespace ensonify::pager;
using Catch::WithinAbs;

namespace {

TerrainPagerConfig surveying(std::vector<MissionStep> steps) {
  TerrainPagerConfig config;
  config.mission.steps = std::move(steps);
  config.mission.run_in_m = 30.0;
  config.mission.depth_m = 4.0;
  return config;
}

const FollowLine kLine{{{0, 0}, {0, 100}}};

}  // namespace

TEST_CASE("a line is run with run-in and run-out, and only the line is surveyed") {
  TerrainPagerConfig config = surveying({kLine});
  config.mission.run_out_m = 20.0;
  const auto legs = track_of(config).legs;
  REQUIRE(legs.size() == 3);
  CHECK(legs[0].key == "mission run-in");
  CHECK(legs[0].line.start_enu_m == Vec2(0, -30));
  CHECK(legs[1].key == "mission runline 1");
  CHECK(legs[2].line.end_enu_m == Vec2(0, 120));
  CHECK_FALSE(legs[0].surveyed);
  CHECK(legs[1].surveyed);
  CHECK(legs[1].reach_m == 4.0);
}

TEST_CASE("sent to another depth, a vehicle is where its last step has left it") {
  const GoAt dive{.depth_m = 30.0};
  const auto depths = [](std::vector<MissionStep> steps) { return track_of(surveying(std::move(steps))).places; };
  const auto behind = depths({kLine, dive, KeepPlace{.for_s = 100.0}});
  REQUIRE(behind.size() == 1);
  CHECK(behind[0].place_enu_m == Vec2(0, 100));
  CHECK(behind[0].reach_m == 30.0);
  const auto there = depths({kLine, KeepPlace{.place_enu_m = Vec2(7, 8)}, dive});
  REQUIRE(there.size() == 2);
  CHECK(there[1].place_enu_m == Vec2(7, 8));
  const auto anywhere = depths({kLine, FollowOrbit{.centre_enu_m = {50, 0}, .radius_m = 20.0}, dive});
  CHECK(anywhere.size() == 32);  // on the circle
  CHECK((anywhere[5].place_enu_m - Vec2(50, 0)).norm() == Approx(20.0));
  CHECK(depths({kLine, GoAt{.altitude_m = 3.0}}).empty());  // it does not go below what it receives
}

TEST_CASE("a depth before the first line is taken up where the vehicle starts") {
  TerrainPagerConfig config = surveying({GoAt{.depth_m = 9.0}, kLine});
  config.vehicles = {{.name = "auv"}};
  config.mission.runlines = {{{0, 0}, {0, 100}}};
  CHECK(track_of(config).places[0].place_enu_m == Vec2(0, -30));
  config.vehicles[0].start = motion::State{.position_enu_m = {5, 6, -2}};
  const auto places = track_of(config).places;
  REQUIRE(places.size() == 2);
  CHECK(places[0].place_enu_m == Vec2(5, 6));
  CHECK(places[1].key == "vehicles.auv.start");
  CHECK(places[1].reach_m == 2.0);
}

TEST_CASE("the depth that a round ends with is that of the next round's first lines") {
  TerrainPagerConfig config = surveying({kLine, GoAt{.depth_m = 9.0}});
  const auto deepest_m = [&] {
    double most_m = 0.0;
    for (const Leg& leg : track_of(config).legs) most_m = std::max(most_m, leg.reach_m);
    return most_m;
  };
  CHECK(deepest_m() == 4.0);
  config.mission.repeat = 2;
  CHECK(deepest_m() == 9.0);
}

TEST_CASE("a vehicle reaches down to its lowest head; of several the shallowest counts") {
  TerrainPagerConfig config = surveying({kLine});
  Vehicle boat{.name = "boat"};
  boat.mountings["bow"].actual.position_body_m = {2.0, 0.0, 1.5};
  boat.mountings["mast"].actual.position_body_m = {0.0, 0.0, -6.0};
  config.vehicles = {boat};
  CHECK(track_of(config).legs.back().reach_m == 5.5);
  config.vehicles.push_back({.name = "auv"});
  CHECK(track_of(config).legs.back().reach_m == 4.0);
}

TEST_CASE("an adaptive survey may go anywhere in its rectangle, run-ins included") {
  TerrainPagerConfig config = surveying({kLine});
  config.mission.adaptive = AdaptivePlan{.centre_enu_m = {100, 50}, .length_m = 60.0, .width_m = 500.0};
  double west_m = 0.0, east_m = 0.0, south_m = 0.0, widest_m = 0.0;
  double last_m = NAN;
  for (const Leg& leg : track_of(config).legs) {
    if (leg.key != "mission adaptive") continue;
    const double east = leg.line.start_enu_m.x();
    west_m = std::min(west_m, east), east_m = std::max(east_m, east);
    south_m = std::min(south_m, leg.line.start_enu_m.y());
    if (!std::isnan(last_m)) widest_m = std::max(widest_m, std::abs(east - last_m));
    last_m = east;
    CHECK(leg.spacing_m == Approx(std::sqrt(60.0 * 500.0 / 1e4)));
  }
  CHECK(west_m == Approx(-150.0));
  CHECK(east_m == Approx(350.0));
  CHECK(south_m == Approx(50.0 - 30.0 - 30.0));
  CHECK(widest_m < 1.74);
}

TEST_CASE("the lowest water is that of the run, or of thirty days") {
  constexpr double kM2_radps = 1.405189e-4, kS2_radps = 1.454441e-4;
  const vertical::Tide tide(vertical::HarmonicTide{0.5, {{kM2_radps, 2.0, 0.0}, {kS2_radps, 0.7, 1.0}}});
  CHECK(lowest_water_m(tide, SimTime(std::chrono::seconds(0))) == Approx(tide.at(0).height_m));
  CHECK(lowest_water_m(tide, SimTime(std::chrono::hours(1))) == Approx(tide.at(3600).height_m));  // it falls
  CHECK_THAT(lowest_water_m(tide, std::nullopt), WithinAbs(0.5 - 2.7, 0.02));                     // at springs
  CHECK(lowest_water_m(vertical::Tide(-5.0), std::nullopt) == -5.0);
}
