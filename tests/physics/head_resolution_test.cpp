#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "components/runtime/head/tile_set.h"
#include "kernels/array/line.h"
#include "tests/physics/area_integral.h"
#include "tests/physics/sidescan_ping.h"

// Two bright strips of a dark level seabed through the whole sidescan head, rays and patches of seabed included, as
// sums of mean squares: the mean over the strips' phases. resolution_test.cpp has the same for points and kernels.

using namespace ensonify;
using namespace ensonify::physics;

namespace {

constexpr double kAltitude_m = 10.0;
constexpr double kPost_m = 0.01;  // a strip is two posts wide

/// Level seabed to starboard of a head at the origin, as far as `reach_m` and `half_m` fore and aft; bright where told.
template <class Bright>
msg::Tile seabed(double reach_m, double half_m, const Bright& bright) {
  const auto along = static_cast<std::size_t>(2.0 * half_m / kPost_m) + 1;
  const auto across = static_cast<std::size_t>(reach_m / kPost_m) + 1;
  msg::Tile tile;
  tile.origin_north_m = -half_m;
  tile.spacing_m = kPost_m;
  tile.height_m = msg::Array<float>({along, across});
  tile.sediment = msg::Array<std::uint8_t>({along, across});
  for (float& height : tile.height_m.flat()) height = static_cast<float>(-kAltitude_m);
  for (std::size_t row = 0; row < along; ++row) {
    for (std::size_t col = 0; col < across; ++col) {
      const double east_m = kPost_m * static_cast<double>(col), north_m = kPost_m * static_cast<double>(row) - half_m;
      tile.sediment(row, col) = bright(east_m, north_m) ? 1 : 0;
    }
  }
  return tile;
}

/// Patches of seabed are a fortieth of the beam at 100 m: 4 mm for 0.1 degrees.
SidescanConfig over_strips(double width_deg, double range_m) {
  SidescanConfig config = sidescan_of(400e3);
  config.world.seabed.sediments[0] = seabed::Lambert{-120.0};
  config.world.seabed.sediments[1] = seabed::Lambert{-10.0};
  config.channels[0].horizontal_beamwidth_rad = width_deg * SidescanChannel::kDegree;
  config.channels[0].range_m = range_m;
  config.effects.speckle = config.effects.absorption = false;
  config.quality = 2.0;
  return config;
}

/// How far the signal falls between its highest point and another that is half as high at least, dB; 0 for one peak.
double dip_db(const std::vector<double>& signal) {
  const auto peak = std::max_element(signal.begin(), signal.end());
  double dip = 0.0;
  const auto outward = [&](auto from, auto to) {
    double lowest = *peak;
    for (auto at = from; at != to; ++at) {
      lowest = std::min(lowest, *at);
      if (*at > 0.5 * *peak) dip = std::max(dip, db(*at / std::max(lowest, 1e-9 * *peak)));
    }
  };
  outward(peak, signal.end());
  outward(std::make_reverse_iterator(peak), signal.rend());
  return dip;
}

struct Dips {
  double shallowest = 1e9, deepest = 0.0;
};

/// Of two strips along the track, `apart_m` of slant range apart and 50 m away, wherever they lie between samples.
Dips across_track(double apart_m) {
  constexpr double kNear_m = 50.0, kHalf_m = 0.25;
  const auto ground_m = [](double slant_m) { return std::sqrt(slant_m * slant_m - kAltitude_m * kAltitude_m); };
  TileSet tiles;
  tiles.insert(seabed(52.0, kHalf_m, [&](double east_m, double) {
    return std::abs(east_m - ground_m(kNear_m)) < kPost_m || std::abs(east_m - ground_m(kNear_m + apart_m)) < kPost_m;
  }));
  const SidescanConfig config = over_strips(0.1, 51.0);
  Dips dips;
  for (int i = 0; i < 4; ++i) {
    const double sample_m = 0.5 * 0.5 * 1500.0 * config.channels[0].pulse_length_s;
    const auto ping = sidescan_ping(config, tiles.scene(), {i * sample_m / 4.0, 0.0, 0.0});
    std::vector<double> powers;
    for (const float a : ping.amplitude_upa.row(1)) powers.push_back(double(a) * double(a));
    const double dip = dip_db(powers);
    dips.shallowest = std::min(dips.shallowest, dip), dips.deepest = std::max(dips.deepest, dip);
  }
  return dips;
}

/// Of two strips across the track as the head passes, 30 m away: of the head's echoes, and of the strips' posts summed
/// directly with sinc^4, the line's pattern squared.
struct AlongTrack {
  double found_db, theory_db;
};
AlongTrack along_track(double apart_in_widths) {
  constexpr double kWidth_deg = 0.25, kRange_m = 30.0, kHalf_m = 1.0;
  const double width_rad = kWidth_deg * std::numbers::pi / 180.0, apart_m = apart_in_widths * kRange_m * width_rad;
  const auto bright = [&](double, double north_m) { return std::abs(std::abs(north_m) - 0.5 * apart_m) < kPost_m; };
  TileSet tiles;
  tiles.insert(seabed(31.0, kHalf_m, bright));
  const SidescanConfig config = over_strips(kWidth_deg, 31.0);
  const double waves = array::length_in_waves_for(width_rad);
  std::vector<double> found, theory;
  for (int step = -6; step <= 6; ++step) {
    const double north_m = 0.02 * step;
    const auto ping = sidescan_ping(config, tiles.scene(), {0.0, north_m, 0.0});
    found.push_back(power_sum(ping, 1, samples_about(ping, kRange_m, 0.8)));
    theory.push_back(0.0);
    for (double post_m = -kHalf_m; post_m <= kHalf_m; post_m += kPost_m) {
      if (!bright(0.0, post_m)) continue;
      theory.back() += std::pow(array::sinc(waves * std::sin((post_m - north_m) / kRange_m)), 4);
    }
  }
  return {dip_db(found), dip_db(theory)};
}

}  // namespace

TEST_CASE(
    "a sidescan parts strips 1.5 x c tau / 2 apart wherever they lie, 1.2 x where a sample falls between, 0.7 x "
    "never") {
  // It takes two samples a pulse. The strips are 10 mm wide in slant range, a seventh of c tau / 2.
  constexpr double kCell_m = 0.075;
  CHECK(across_track(1.65 * kCell_m).shallowest > 3.0);
  CHECK(across_track(1.2 * kCell_m).deepest > 3.0);
  CHECK(across_track(0.7 * kCell_m).deepest < 1.0);
}

TEST_CASE("a sidescan parts strips 1.2 beam widths apart along the track, and not 0.7") {
  // Points 1.2 one-way widths apart dip by 5.9 dB; these strips are a sixth of a width wide, and lie on posts. Some
  // hundred rays meet each: 0.3 dB.
  const AlongTrack two = along_track(1.2), one = along_track(0.7);
  CHECK(two.theory_db > 3.5);
  CHECK(two.found_db > 3.0);
  CHECK(two.found_db == Approx(two.theory_db).margin(0.7));
  CHECK(one.found_db < 0.5);
}
