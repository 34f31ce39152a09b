#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "components/sidescan/head.h"
#include "components/sonar/testing/config.h"
#include "components/sonar/testing/ping.h"
#include "components/sonar/tile_set.h"
#include "kernels/acoustics/array/line.h"

// A line inside L^2 / lambda, through the whole head, against the sum over its elements by exact distances: a bright
// strip across the track of a dark level seabed, as the head passes it. Sums of mean squares: the mean over the strip's
// phases.

using namespace ensonify;
using Catch::WithinAbs;

namespace {

constexpr double kWavelength_m = 0.00375;  // 400 kHz in 1500 m/s
constexpr double kLength_m = 0.4743;       // of the line: L^2 / lambda is 60 m
constexpr double kRange_m = 15.0;          // a quarter of it
constexpr double kUnfocused_m = std::numeric_limits<double>::infinity();
constexpr double kAltitude_m = 10.0;
constexpr double kWindow_m = 0.6;  // before and behind it
constexpr double kStrip_m = 0.06;  // wide: one row of posts, half of a focused beam

SidescanConfig sidescan(Focus focus) {
  SidescanConfig config;
  world_of(config).water.profile.sound_speed_mps = 1500.0;
  world_of(config).seabed.sediments = {{0, seabed::Lambert{-120.0}}, {1, seabed::Lambert{-10.0}}};
  config.effects.directivity = config.effects.speckle = config.effects.noise = false;
  config.effects.multipath = config.effects.absorption = false;
  config.quality = 4;
  SidescanChannel& channel = config.channels[0];
  channel.focus = focus;
  channel.focus_m = focus == Focus::kFixed ? 40.0 : 0.0;
  channel.horizontal_beamwidth_rad = array::half_power_width_rad(kLength_m / kWavelength_m);
  channel.range_m = kRange_m + 1.0;
  return config;
}

/// To starboard of the head, 1 m fore and aft of the strip.
TileSet strip_across_the_track() {
  constexpr std::size_t kAlong = 35, kAcross = 268, kMiddle = kAlong / 2;
  msg::Tile tile;
  tile.origin_north_m = -kStrip_m * kMiddle;
  tile.spacing_m = kStrip_m;
  tile.height_m = msg::Array<float>({kAlong, kAcross});
  tile.sediment = msg::Array<std::uint8_t>({kAlong, kAcross});
  for (float& height : tile.height_m.flat()) height = static_cast<float>(-kAltitude_m);
  for (std::size_t col = 0; col < kAcross; ++col) tile.sediment(kMiddle, col) = 1;
  TileSet tiles;
  tiles.insert(tile);
  return tiles;
}

/// The power that comes back from about the range when the head is so far north of the strip's middle, any unit.
double found(const SidescanConfig& config, TileSet& tiles, double north_m) {
  frames::PoseHistory at_rest(1'000'000'000);
  at_rest.push(0, {{0.0, north_m, 0.0}, frames::enu_from_ned()});
  Sidescan head(config, 0);
  const HeadSettings settings = config.start_of(config.channels[0]);
  const auto ping = image_of(head, {0, SimTime{0}, settings.range_m}, settings, around(at_rest, tiles.scene()));
  double sum = 0.0;
  for (std::size_t k = 0; k < ping.amplitude_upa.cols(); ++k) {
    const double slant_m = 750.0 * static_cast<double>(k) * static_cast<double>(ping.sample_period_s);
    if (std::abs(slant_m - kRange_m) < kWindow_m) sum += std::pow(static_cast<double>(ping.amplitude_upa(1, k)), 2);
  }
  return sum;
}

/// Power that a point so far along the track has in the line, over that of the far field's axis.
double element_sum(double along_m, double range_m, double focus_m) {
  constexpr int kElements = 200;
  std::complex<double> sum = 0.0;
  for (int n = 0; n < kElements; ++n) {
    const double x = kLength_m * ((n + 0.5) / kElements - 0.5);
    const double longer_m = std::sqrt(range_m * range_m - 2.0 * along_m * x + x * x) - range_m;
    const double delayed_m = std::isfinite(focus_m) ? std::sqrt(focus_m * focus_m + x * x) - focus_m : 0.0;
    sum += std::polar(1.0, 2.0 * std::numbers::pi / kWavelength_m * (longer_m - delayed_m));
  }
  return std::norm(sum) / (kElements * kElements);
}

/// The same power by the sums over elements, of transmission and of reception, over the strip within the window. A
/// width of it is y dy = R dR across the track, scatters sin^2 = (H / R)^2 by Lambert's law, and spreads R^-4.
double theory(Focus focus, double north_m) {
  constexpr int kRanges = 9, kAlongs = 8;
  double sum = 0.0;
  for (int i = 0; i < kRanges; ++i) {
    const double R = kRange_m + kWindow_m * ((2 * i + 1.0) / kRanges - 1.0);
    const double weight = std::pow(R, -5) / std::sqrt(R * R - kAltitude_m * kAltitude_m);
    const double sending = focus == Focus::kIdeal ? R : kUnfocused_m;
    const double reception = focus == Focus::kFixed ? 40.0 : focus == Focus::kOff ? kUnfocused_m : R;
    for (int j = 0; j < kAlongs; ++j) {
      const double along_m = kStrip_m * ((j + 0.5) / kAlongs - 0.5) - north_m;
      sum += weight * element_sum(along_m, R, sending) * element_sum(along_m, R, reception);
    }
  }
  return sum;
}

double db(double ratio) { return 10.0 * std::log10(ratio); }

}  // namespace

TEST_CASE("at L^2 / 4 lambda a sidescan's line has the gain and width of its elements' sum") {
  // 4.0 dB below the ideal line on the axis where only transmission is unfocused, 7.9 dB where nothing is; beside the
  // axis an unfocused line has a shoulder at -4 dB, so that half widths would show little. Patches of seabed of 17 mm,
  // which answer as one point, blur the strip: 0.15 dB at -6 dB, and more in nulls, which are left out. Some hundred
  // rays beside the main lobe: 0.1 dB.
  TileSet tiles = strip_across_the_track();
  const double ideal_found = found(sidescan(Focus::kIdeal), tiles, 0.0), ideal = theory(Focus::kIdeal, 0.0);
  for (const Focus focus : {Focus::kIdeal, Focus::kEcho, Focus::kFixed, Focus::kOff}) {
    for (const double north_m : {0.0, 0.03, 0.06, 0.12, 0.18}) {
      const double expected_db = db(theory(focus, north_m) / ideal);
      if (expected_db < -20.0) continue;
      INFO("focus " << static_cast<int>(focus) << ", " << north_m << " m beside the strip");
      CHECK_THAT(db(found(sidescan(focus), tiles, north_m) / ideal_found), WithinAbs(expected_db, 0.3));
    }
  }
}

TEST_CASE("beyond L^2 / lambda focusing makes no difference") {
  // At 4 L^2 / lambda an unfocused line is 0.015 dB weaker on its axis than a focused one, each way.
  for (const Focus focus : {Focus::kEcho, Focus::kOff}) {
    const auto ideal = side_patterns(sidescan(Focus::kIdeal), sidescan(Focus::kIdeal).channels[0]);
    const auto real = side_patterns(sidescan(focus), sidescan(focus).channels[0]);
    for (double u = -0.007; u <= 0.007; u += 0.0005) {  // within the first nulls
      const Eigen::Vector3f direction(static_cast<float>(u), 1.0F, 0.0F);
      CHECK_THAT(real.transmit[1].amplitude(direction, 240.0F),
                 WithinAbs(std::abs(ideal.transmit[1].amplitude(direction, 240.0F)), 0.02));
      CHECK_THAT(real.receive[1].amplitude(direction, 240.0F),
                 WithinAbs(std::abs(ideal.receive[1].amplitude(direction, 240.0F)), 0.02));
    }
  }
}
