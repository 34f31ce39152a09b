#include "kernels/array/near_field.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <vector>

#include "components/runtime/head/tile_set.h"
#include "components/sidescan/head.h"
#include "kernels/array/line.h"

// A line inside L^2 / lambda, through the whole head, against the sum over its elements: a bright strip across the
// track of a dark level seabed, as the head passes it. Sums of mean squares: the mean over the strip's phases.

using namespace ensonify;

namespace {

constexpr double kWavelength_m = 0.00375;  // 400 kHz in 1500 m/s
constexpr double kLength_m = 0.4743;       // of the line: L^2 / lambda is 60 m
constexpr double kRange_m = 15.0;          // a quarter of it
constexpr double kAltitude_m = 10.0;
constexpr double kPost_m = 0.02;
constexpr double kStrip_m = 0.06;  // wide: three posts, half of a focused beam

SidescanConfig sidescan(Focus focus) {
  SidescanConfig config;
  config.world.water.profile.sound_speed_mps = 1500.0;
  config.world.seabed.sediments = {{0, seabed::Lambert{-120.0}}, {1, seabed::Lambert{-10.0}}};
  config.effects.directivity = config.effects.speckle = config.effects.noise = false;
  config.effects.multipath = config.effects.absorption = false;
  config.quality = 8.0;
  SidescanChannel& channel = config.channels[0];
  channel.focus = focus;
  channel.focus_m = focus == Focus::kFixed ? 40.0 : 0.0;
  channel.horizontal_beamwidth_rad = array::half_power_width_rad(kLength_m / kWavelength_m);
  channel.range_m = kRange_m + 1.0;
  return config;
}

/// To starboard of the head, 1 m fore and aft of the strip.
TileSet strip_across_the_track() {
  constexpr std::size_t kAlong = 101, kAcross = 801, kMiddle = kAlong / 2;
  msg::Tile tile;
  tile.origin_north_m = -kPost_m * kMiddle;
  tile.spacing_m = kPost_m;
  tile.height_m = msg::Array<float>({kAlong, kAcross});
  tile.sediment = msg::Array<std::uint8_t>({kAlong, kAcross});
  for (float& height : tile.height_m.flat()) height = static_cast<float>(-kAltitude_m);
  for (std::size_t col = 0; col < kAcross; ++col) {
    for (const std::size_t row : {kMiddle - 1, kMiddle, kMiddle + 1}) tile.sediment(row, col) = 1;
  }
  TileSet tiles;
  tiles.insert(tile);
  return tiles;
}

/// The power that comes back from about the range when the head is so far north of the strip's middle, any unit.
double found(const SidescanConfig& config, const TileSet& tiles, double north_m) {
  frames::PoseHistory at_rest(1'000'000'000);
  at_rest.push(0, {{0.0, north_m, 0.0}, frames::enu_from_ned()});
  SidescanHead head(config, config.channels[0]);
  const HeadSettings settings = config.start_of(config.channels[0]);
  const auto ping = head.listen({0, SimTime{0}, settings.range_m}, settings, at_rest, tiles.scene()).ping;
  double sum = 0.0;
  for (std::size_t k = 0; k < ping.amplitude_upa.cols(); ++k) {
    const double slant_m = 750.0 * static_cast<double>(k) * static_cast<double>(ping.sample_period_s);
    if (std::abs(slant_m - kRange_m) < 0.6) sum += std::pow(static_cast<double>(ping.amplitude_upa(1, k)), 2);
  }
  return sum;
}

/// The same by the sums over elements, of sending and of listening, over the strip.
double theory(Focus focus, double north_m) {
  static const array::LineArray line{
      .spacing_m = kLength_m / 500, .weights = std::vector<double>(500, 1.0), .element_length_m = kLength_m / 500};
  const double focus_m = focus == Focus::kFixed ? 40.0 : array::kFarAway_m;
  double sum = 0.0;
  for (int step = 0; step < 12; ++step) {
    const double strip_m = kStrip_m * ((step + 0.5) / 12.0 - 0.5);
    const double u = (strip_m - north_m) / kRange_m;
    const auto power = [&](double focused_at_m) {
      return std::norm(array::near_field_amplitude(line, kWavelength_m, u, 0.0, kRange_m, focused_at_m));
    };
    const double sent = power(focus == Focus::kIdeal ? kRange_m : array::kFarAway_m);
    sum += sent * power(focus == Focus::kIdeal || focus == Focus::kEcho ? kRange_m : focus_m);
  }
  return sum;
}

constexpr double kStep_m = 0.03;

std::vector<double> profile(const std::function<double(double north_m)>& power) {
  std::vector<double> powers;
  for (int i = 0; i <= 9; ++i) powers.push_back(power(i * kStep_m));
  return powers;
}

/// Where it falls to a half of its first, from straight lines between.
double half_width_m(const std::vector<double>& powers) {
  std::size_t i = 1;
  while (i + 1 < powers.size() && powers[i] > 0.5 * powers[0]) ++i;
  return kStep_m * (static_cast<double>(i) - (0.5 * powers[0] - powers[i]) / (powers[i - 1] - powers[i]));
}

double db(double ratio) { return 10.0 * std::log10(ratio); }

}  // namespace

TEST_CASE("at a quarter of L^2 / lambda a sidescan's line is as weak and as wide as the sum over its elements says") {
  // 4.0 dB below the ideal line on the axis where only transmission is unfocused, 8.1 dB where nothing is. Some four
  // hundred rays meet the strip: 0.15 dB; patches of seabed, which answer as one point, are a quarter of a beam at 10
  // m.
  const TileSet tiles = strip_across_the_track();
  const double ideal_found = found(sidescan(Focus::kIdeal), tiles, 0.0), ideal = theory(Focus::kIdeal, 0.0);
  for (const Focus focus : {Focus::kIdeal, Focus::kEcho, Focus::kFixed, Focus::kOff}) {
    const auto heard = profile([&](double north_m) { return found(sidescan(focus), tiles, north_m); });
    const auto expected = profile([&](double north_m) { return theory(focus, north_m); });
    INFO("focus " << static_cast<int>(focus) << ": " << db(heard[0] / ideal_found) << " dB, expected "
                  << db(expected[0] / ideal) << "; half width " << half_width_m(heard) << " m, expected "
                  << half_width_m(expected));
    CHECK(db(heard[0] / ideal_found) == Approx(db(expected[0] / ideal)).margin(0.5));
    CHECK(half_width_m(heard) == Approx(half_width_m(expected)).epsilon(0.07));
    for (std::size_t i = 1; i < heard.size(); ++i) {
      if (expected[i] < 0.1 * expected[0]) continue;
      CHECK(db(heard[i] / heard[0]) == Approx(db(expected[i] / expected[0])).margin(0.7));
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
      CHECK(real.transmit[1](direction, 240.0F) == Approx(std::abs(ideal.transmit[1](direction, 240.0F))).margin(0.02));
      CHECK(real.receive[1](direction, 240.0F) == Approx(std::abs(ideal.receive[1](direction, 240.0F))).margin(0.02));
    }
  }
}
