#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "components/multibeam/node.h"
#include "components/sonar/testing/seabed.h"
#include "kernels/base/random/stream.h"
#include "tests/physics/heads.h"

// Objects on the seabed of 20 m in a survey at 2 m/s: how many soundings fall on each. The whole head, through its
// ports.

using namespace ensonify;
using namespace ensonify::physics;

namespace {

constexpr double kDepth_m = 20.0, kSpeed_mps = 2.0;
constexpr int kRows = 25, kPerRow = 4;
constexpr double kRowSpacing_m = 2.5, kPostSpacing_m = 0.1;
constexpr double kFirstRow_m = -0.5 * (kRows - 1) * kRowSpacing_m;

struct Cube {
  double east_m, north_m, side_m;

  bool holds(double east, double north, double grown_m) const {
    return std::max(std::abs(east - east_m), std::abs(north - north_m)) <= 0.5 * side_m + grown_m;
  }
};

/// 100 cubes at random within +-`half_swath_rad` of the track, four in each row, one in each quarter of the width.
void strew(double side_m, double half_swath_rad, const random::Stream& draws, std::vector<Cube>& cubes) {
  const double half_m = kDepth_m * std::tan(half_swath_rad) - 0.5 * side_m, quarter_m = 0.5 * half_m;
  for (int row = 0; row < kRows; ++row) {
    for (int i = 0; i < kPerRow; ++i) {
      for (std::uint64_t attempt = 0;; ++attempt) {
        const auto draw = [&](std::uint64_t what) { return draws.uniform(row * kPerRow + i, attempt, what); };
        const Cube cube{-half_m + quarter_m * (i + draw(0)), kFirstRow_m + kRowSpacing_m * row + draw(1) - 0.5, side_m};
        // Clear of its neighbours and of their shadows.
        const bool clear = std::ranges::none_of(cubes, [&](const Cube& other) {
          return std::abs(other.north_m - cube.north_m) < kRowSpacing_m - 0.5 &&
                 std::abs(other.east_m - cube.east_m) < 3.5;
        });
        if (!clear && attempt < 1000) continue;
        cubes.push_back(cube);
        break;
      }
    }
  }
}

/// A plane with cubes on it: posts within a cube stand at its top, so its walls lean by one spacing of posts and are
/// where they should be half way up.
msg::Tile seabed_with(const std::vector<Cube>& cubes) {
  return tile_of(90.0, kPostSpacing_m, [&](double east, double north) {
    for (const Cube& cube : cubes) {
      if (cube.holds(east, north, 0.0)) return cube.side_m - kDepth_m;
    }
    return -kDepth_m;
  });
}

/// Soundings on each cube: over its plan, grown by 0.1 m (twice the 5 cm that a sounding may err), and a quarter of its
/// side above the seabed or higher.
std::vector<int> soundings_on(const std::vector<Cube>& cubes, const std::vector<msg::Soundings>& pings) {
  std::vector<int> count(cubes.size());
  for (const msg::Soundings& ping : pings) {
    for (std::size_t i = 0; i < ping.valid.size(); ++i) {
      if (ping.valid[i] == 0) continue;
      const double east = ping.position_enu_m(i, 0), north = ping.position_enu_m(i, 1), up = ping.position_enu_m(i, 2);
      for (std::size_t c = 0; c < cubes.size(); ++c) {
        count[c] += cubes[c].holds(east, north, 0.1) && up > 0.25 * cubes[c].side_m - kDepth_m;
      }
    }
  }
  return count;
}

}  // namespace

TEST_CASE("95 % of 0.5 m cubes within 45 degrees and 1 m within 60 get 9 soundings") {
  // A head of the 1 x 0.5 degree class at 400 kHz, 512 beams over 130 degrees, as fast as 48 m of range allow.
  const std::string yaml =
      "frequency_hz: 400000\nbeams: 512\nswath_deg: 130\ntransmit_beamwidth_deg: 1\nreceive_beamwidth_deg: 0.5\n"
      "pulse_length_s: 5e-5\nsample_rate_hz: 40000\nauto_range: false\nrange_m: 48\nping_rate_hz: 60\n"
      "amplitude_every: 1000000\n";
  std::vector<Cube> cubes;
  strew(0.5, std::numbers::pi / 4, {1, "small cubes"}, cubes);
  strew(1.0, std::numbers::pi / 3, {1, "large cubes"}, cubes);
  const World world = world_with("head");
  NodeUnderTest<MultibeamNode> head(config_of<MultibeamNode>(yaml, world, "head"));
  const double lead_m = 1.5;
  const SimTime end = from_seconds((2.0 * (-kFirstRow_m + lead_m)) / kSpeed_mps);
  give_course(head, {{0.0, kFirstRow_m - lead_m, 0.0}, {0.0, kSpeed_mps, 0.0}}, end);
  head.give("tile", seabed_with(cubes));
  const std::vector<int> count = soundings_on(cubes, head.step_until<msg::Soundings>("soundings", end));

  for (const auto& [side_m, first] : {std::pair{0.5, 0}, {1.0, kRows * kPerRow}}) {
    const auto begin = count.begin() + first;
    const auto enough = std::count_if(begin, begin + kRows * kPerRow, [](int n) { return n >= 9; });
    INFO(side_m << " m: " << enough << " of 100 have 9, the fewest " << *std::min_element(begin, begin + 100));
    CHECK(enough >= 95);
  }
}
