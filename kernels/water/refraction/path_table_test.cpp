#include "kernels/water/refraction/path_table.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "kernels/base/testing/allocations.h"
#include "kernels/water/refraction/thermocline.h"

using namespace ensonify::refraction;
using Catch::WithinAbs;
constexpr double kDeg = std::numbers::pi / 180;

static std::vector<SoundSpeedProfile> waters() {
  return {summer_thermocline(), SoundSpeedProfile::uniform(1500),
          SoundSpeedProfile({{0, 1470}, {80, 1530}}),                                      // bends up: rays turn below
          SoundSpeedProfile({{0, 1500}, {20, 1500}, {21, 1520}, {40, 1490}, {60, 1520}}),  // two ridges of speed
          SoundSpeedProfile({{-5, 1500}, {30, 1500.01}, {60, 1500}})};                     // all but uniform
}

TEST_CASE("the table gives the exact arcs within 1 mm and a millionth of the time") {
  PathTable table;
  for (const auto& water : waters()) {
    for (const auto& [source, level] : {std::pair{0.5, 75.0}, {25.0, 40.0}, {60.0, 61.0}}) {
      table.build(water, source, level);
      for (double degrees = 0.5; degrees < 90; degrees += 0.237) {
        for (const double depth : {level, level + 2.5, 85.0}) {
          INFO(degrees << " degrees, " << source << " to " << depth << " m");
          const auto exact = path_to_depth(water, source, degrees * kDeg, depth, 1);
          const auto found = table.at(degrees * kDeg, depth);
          REQUIRE(found.has_value() == exact.has_value());
          if (!exact) continue;
          // What the header promises; the bound of a cubic is h^4/384 of the fourth derivative, h = 1/16 of w.
          const double across = std::abs(std::sin(exact->depression_rad));
          REQUIRE_THAT((found->horizontal_m - exact->horizontal_m) * across, WithinAbs(0, 2e-7 * exact->path_length_m));
          REQUIRE(found->travel_time_s == Approx(exact->travel_time_s).epsilon(2e-7));
          REQUIRE(found->path_length_m == Approx(exact->path_length_m).epsilon(2e-7));
          REQUIRE_THAT(found->depression_rad, WithinAbs(exact->depression_rad, 1e-9));
          REQUIRE(found->tube_m2 == Approx(exact->tube_m2).epsilon(3e-5));  // 0.0001 dB
        }
      }
    }
  }
}

TEST_CASE("at 75 degrees through ten layers over 80 m: within 1 mm and a millionth") {
  const auto water = summer_thermocline();
  PathTable table;
  table.build(water, 0, 77);
  const auto exact = path_to_depth(water, 0, 15 * kDeg, 80), found = table.at(15 * kDeg, 80);
  CHECK(std::abs(found->horizontal_m - exact->horizontal_m) < 1e-3);
  CHECK(found->travel_time_s == Approx(exact->travel_time_s).epsilon(1e-6));
}

TEST_CASE("paths that the table does not serve come from exact arcs") {
  const auto water = summer_thermocline();
  PathTable table;
  table.build(water, 30, 60);
  CHECK(table.path(1, 0).at().depth_m == 60);
  CHECK(table.path(0, 1).at().depth_m == 30);       // flat
  CHECK(table.path(-0.6, 0.8).at().depth_m == 30);  // up
  for (const double degrees : {-80.0, -3.0, -1.0, 0.0, 0.3}) {
    for (const double depth : {5.0, 30.0, 45.0, 70.0}) {
      const auto exact = path_to_depth(water, 30, degrees * kDeg, depth, 1), found = table.at(degrees * kDeg, depth);
      REQUIRE(found.has_value() == exact.has_value());
      if (exact) CHECK(found->travel_time_s == Approx(exact->travel_time_s).epsilon(1e-9));
    }
  }
  table.build(water, 30, 20);  // geometry above the source: no table
  CHECK(table.path(1, 0).at().depth_m == 30);
  CHECK_THROWS_WITH(table.build(water, 30, std::nan("")), "the depths of a table of paths must be finite");
}

TEST_CASE("a table that is built again takes no new memory") {
  const auto water = summer_thermocline();
  PathTable table;
  table.build(water, 0, 80);
  const long before = allocations();
  for (int ping = 0; ping < 10; ++ping) table.build(water, 0.1 * ping, 80);
  CHECK(allocations() == before);
}
