#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>

#include "components/config/config_error.h"
#include "components/terrain_pager/corridors.h"
#include "components/terrain_pager/mission_track.h"

using namespace ensonify;
using namespace ensonify::pager;
using Catch::WithinAbs;

namespace {

/// 10 km x 10 km with posts every 0.1 m, that counts how many it is asked for.
class Counting : public TerrainSource {
 public:
  explicit Counting(std::function<double(double, double)> height_m) : height_m_(std::move(height_m)) {}
  Extent extent() const override { return {-5000.0, -5000.0, 5000.0, 5000.0}; }
  double lowest_m() const override { return -1000.0; }
  double highest_m() const override { return 10.0; }
  frames::Geodetic origin() const override { return {}; }
  double native_spacing_m() const override { return 0.1; }
  void sample(const source::PostBlock& posts, std::span<float> height_m, std::span<std::uint8_t>) const override {
    for (int row = 0; row < posts.rows; ++row) {
      for (int column = 0; column < posts.columns; ++column, ++posts_made) {
        const auto k = static_cast<std::size_t>(row) * static_cast<std::size_t>(posts.columns);
        height_m[k + static_cast<std::size_t>(column)] =
            static_cast<float>(height_m_(posts.east_m(column), posts.north_m(row)));
      }
    }
  }
  double height_m(const Vec2& place) const override { return height_m_(place.x(), place.y()); }

  mutable std::size_t posts_made = 0;

 private:
  std::function<double(double, double)> height_m_;
};

const CorridorRules kHolesAllowed{.refuse_holes = false};

Leg leg_along(const runlines::Runline& line) {
  return {.line = line, .place = {"sea.yaml", 12, 7}, .key = "mission runline 1", .surveyed = true};
}

std::string fault(const TerrainSource& terrain, const runlines::Runline& line, double reach_m,
                  double lowest_water_m = 0.0) {
  Leg leg = leg_along(line);
  leg.reach_m = reach_m;
  try {
    check_corridors(terrain, {leg}, {.refuse_holes = false, .lowest_water_m = lowest_water_m});
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("along a line of kilometres the least depth is found from few posts") {
  const Counting slope([](double x, double y) { return -30.0 + 1e-3 * (x + 2.0 * y); });
  const runlines::Runline line{{-3000, -3000}, {3000, 3000}};
  CHECK_THAT(check_corridors(slope, {leg_along(line)}, kHolesAllowed),
             WithinAbs(30.0 - 9.0, 1e-3));  // at its end, to a float's rounding
  // Samples stand 4.24 m apart; 64 of them lie on a square of 3 m x 63 in 47 posts a side, 32 times.
  CHECK(slope.posts_made < 2 * 32 * 50 * 50);
}

TEST_CASE("a short line is looked at post by post") {
  const Counting rock([](double x, double y) { return std::hypot(x - 20.0, y) < 0.5 ? -3.0 : -30.0; });
  CHECK(check_corridors(rock, {leg_along({{-40, 0}, {40, 0}})}, kHolesAllowed) == Approx(3.0));
}

TEST_CASE("an obstacle floor above all of a line's water is refused, above a part is not") {
  const Counting slope([](double x, double) { return -30.0 + 5e-3 * x; });  // 10 to 50 m deep
  const runlines::Runline line{{-4000, 0}, {4000, 0}};
  const auto with_floor = [&](double least_altitude_m, std::optional<double> altitude_m = std::nullopt) {
    Leg leg = leg_along(line);
    leg.altitude_m = altitude_m;
    try {
      check_corridors(slope, {leg}, {.refuse_holes = false, .least_altitude_m = least_altitude_m});
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK(with_floor(49.0) == "accepted");
  CHECK(with_floor(51.0) ==
        "sea.yaml:12:7: mission runline 1: least_altitude_m 51.0 leaves no depth to dive to, the deepest place is at "
        "50.0 m; allowed is less");
  CHECK(with_floor(0.0, 49.0) == "accepted");
  CHECK(with_floor(0.0, 51.0).find("altitude_m 51.0 leaves no depth to dive to") != std::string::npos);
}

TEST_CASE("a line over land or through the seabed is refused, one over a hole is not") {
  const Counting ridge(
      [](double x, double) { return x > 2000 ? std::nan("") : -40.0 + 39.0 * std::exp(-x * x / 1e4); });
  const runlines::Runline line{{-4000, 10}, {4000, 10}};
  CHECK(fault(ridge, line, 0.5) == "accepted");
  const std::string through = fault(ridge, line, 20.0);
  CHECK(through.find("sea.yaml:12:7: mission runline 1: at (-") == 0);
  CHECK(through.find("the vehicle would reach 20.0 m deep and the seabed is") != std::string::npos);
  const Counting island([](double x, double) { return -40.0 + 45.0 * std::exp(-x * x / 1e4); });
  CHECK(fault(island, line, 0.0).find("is land") != std::string::npos);
}

TEST_CASE("depths count from the lowest water: low tide dries a bank, high tide clears it") {
  const Counting bank([](double x, double) { return -8.0 + 9.0 * std::exp(-x * x / 1e4); });  // up to 1 m above datum
  const runlines::Runline over{{-400, 0}, {400, 0}}, beside{{-400, 0}, {-300, 0}};
  CHECK(fault(bank, over, 0.0, 0.0).find("is land, 0.0 m above chart datum with the lowest water at 0.0 m") !=
        std::string::npos);
  CHECK(fault(bank, over, 0.5, 1.6) == "accepted");
  CHECK(fault(bank, over, 0.7, 1.6).find("reach 0.7 m deep and the seabed is 0.") != std::string::npos);
  CHECK(fault(bank, beside, 6.0, -1.9) == "accepted");
  CHECK(fault(bank, beside, 6.0, -2.1).find("reach 6.0 m deep and the seabed is 5.9 m below") != std::string::npos);
  CHECK(fault(bank, beside, 0.0, -9.0).find("is land, -8.0 m above chart datum with the lowest water at -9.0 m") !=
        std::string::npos);
}

TEST_CASE("a key and place have one problem, however many legs show it") {
  const Counting land([](double, double) { return 1.0; });
  const std::vector<Leg> sides = {leg_along({{0, 0}, {50, 0}}), leg_along({{50, 0}, {50, 50}})};
  try {
    check_corridors(land, sides, kHolesAllowed);
    FAIL("accepted");
  } catch (const ConfigError& error) {
    CHECK(error.problems().size() == 1);
  }
}
