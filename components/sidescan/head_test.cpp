#include "components/sidescan/head.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "components/sonar/testing/config.h"
#include "components/sonar/testing/ping.h"
#include "components/sonar/testing/seabed.h"
#include "components/sonar/tile_set.h"
#include "kernels/acoustics/array/line.h"
#include "kernels/water/noise.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

/// The sidescan of the closed form's example: 210 dB, 100 us, 0.5 degrees, in water of 1500 m/s and 0.1 dB/m over a
/// Lambert seabed of -25 dB. Only what the closed form knows is on: no noise, no speckle, no sound by the surface, no
/// vertical pattern.
SidescanConfig plain_sidescan() {
  SidescanConfig config;
  world_of(config).water.profile.sound_speed_mps = 1500.0;
  world_of(config).water.absorption_dbpm = 0.1;
  world_of(config).seabed.sediments = {{0, seabed::Lambert{-25.0}}};
  config.channels[0].source_level_db = 210.0;
  config.channels[0].horizontal_beamwidth_rad = 0.5 * SidescanChannel::kDegree;
  config.effects.directivity = config.effects.speckle = config.effects.noise = config.effects.multipath = false;
  return config;
}

constexpr double kDeg = std::numbers::pi / 180.0;
constexpr double kDepth_m = 12.0;  // of the head, whose heading is north and whose seabed is 10 m below

/// A vehicle at rest under way in attitude only: yawing at this rate about its heading at t = 0.
frames::PoseHistory yawing(double rate_radps, double depth_m = kDepth_m) {
  frames::PoseHistory poses(10'000'000'000);
  for (int i = 0; i <= 60; ++i) {
    const double t = 0.005 * i;
    poses.push(from_seconds(t).count(), {{0, 0, -depth_m}, frames::enu_from_body({rate_radps * t, 0, 0})});
  }
  return poses;
}

struct Sea {
  mutable TileSet tiles;  // a head makes its mesh of them
  explicit Sea(const msg::Tile& tile) { tiles.insert(tile); }
};

Sea flat(double height_m = -kDepth_m - 10.0) {
  return Sea(tile_of(256, 1.0, [=](double, double) { return height_m; }));
}

struct Received {
  msg::Ping ping;
  msg::BottomTrack bottom;
};

Received received_by(Sidescan&& head, const SidescanConfig& config, const Sea& sea, const frames::PoseHistory& truth,
                     std::int64_t ping = 0) {
  const HeadSettings settings = config.start_of(config.channels[0]);
  auto report = report_of(head, {ping, SimTime{0}, settings.range_m}, settings, around(truth, sea.tiles.scene()));
  auto& [image, bottom, labels, energies] = report.messages;
  return {std::move(*image), std::move(*bottom)};
}

Received received(const SidescanConfig& config, const Sea& sea, double yaw_radps = 0.0, std::int64_t ping = 0) {
  return received_by(Sidescan(config, 0), config, sea, yawing(yaw_radps), ping);
}

/// Mean power of a side over +-`around_m` of slant range, dB. The echo at time t is that of slant ranges
/// c (t - tau) / 2 .. c t / 2: their middle is the range.
double level_db(const msg::Ping& ping, std::size_t side, double range_m, double around_m = 0.7) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < ping.amplitude_upa.cols(); ++k) {
    const double t = ping.first_sample_s + static_cast<double>(k) * ping.sample_period_s;
    if (std::abs(750.0 * (t - 0.5 * ping.applied.pulse_length_s) - range_m) > around_m) continue;
    sum += std::pow(ping.amplitude_upa(side, k), 2);
    ++count;
  }
  return 10.0 * std::log10(sum / count);
}

}  // namespace

TEST_CASE("the level on a flat Lambert seabed is that of the area integral, on both sides") {
  // docs/physics/acoustics/echo.md: the pulse-limited strip with the two-way width of the line. Rays in strata leave
  // less than 0.1 dB in the mean over 1.4 m.
  const auto ping = received(plain_sidescan(), flat()).ping;
  REQUIRE(ping.amplitude_upa.rows() == 2);
  const std::pair<double, double> anchors[] = {{20, 103.50}, {50, 77.06}, {99, 52.37}};
  for (const auto& [range_m, expected_db] : anchors) {
    INFO("slant range " << range_m);
    CHECK_THAT(level_db(ping, 0, range_m), WithinAbs(expected_db, 0.3));
    CHECK_THAT(level_db(ping, 1, range_m), WithinAbs(expected_db, 0.3));
  }
}

TEST_CASE("the vertical pattern shapes the level across the track, two-way") {
  SidescanConfig config = plain_sidescan();
  const auto plain = received(config, flat()).ping;
  config.effects.directivity = true;
  const auto shaped = received(config, flat()).ping;
  const double waves = array::length_in_waves_for(50 * kDeg);
  for (const double range_m : {15.0, 20.0, 40.0, 80.0}) {
    INFO("slant range " << range_m);
    // Below the horizon by asin(H / R); the axis is 30 degrees below it.
    const double off_axis = std::asin(10.0 / range_m) - 30 * kDeg;
    const double two_way_db = 20.0 * std::log10(array::line_power(waves, std::sin(off_axis)));
    CHECK_THAT(level_db(shaped, 1, range_m) - level_db(plain, 1, range_m), WithinAbs(two_way_db, 0.1));
    CHECK_THAT(level_db(shaped, 0, range_m), WithinAbs(level_db(shaped, 1, range_m), 0.3));
  }
}

TEST_CASE("a shaded line keeps its -3 dB width and has the set side lobe level") {
  SidescanConfig config = plain_sidescan();
  config.channels[0].shading = {array::Shading::Window::kTaylor, 30.0, 4};
  const auto at = [&](double sine) {  // of the starboard side, abeam
    const auto patterns = side_patterns(config, config.channels[0]);
    const Eigen::Vector3d direction(sine, std::sqrt(1.0 - sine * sine), 0.0);
    return 20.0 *
           std::log10(std::abs(static_cast<double>(patterns.transmit[1].amplitude(direction.cast<float>(), 1.0F))) +
                      1e-9);
  };
  CHECK_THAT(at(0.0), WithinAbs(0.0, 0.01));
  CHECK_THAT(at(std::sin(0.25 * kDeg)), WithinAbs(-3.01, 0.02));
  // Null 1.189 lambda / L off the axis, L that of a uniform line; the highest side lobe at -30.3 dB
  // (docs/physics/acoustics/arrays.md).
  const double wave_over_length = 1.0 / array::length_in_waves_for(0.5 * kDeg);
  double highest_db = -100.0;
  for (double u = 1.25; u < 5.0; u += 0.05) highest_db = std::max(highest_db, at(u * wave_over_length));
  CHECK_THAT(highest_db, WithinAbs(-30.3, 0.2));
  config.effects.side_lobes = false;
  CHECK(at(1.25 * wave_over_length) < -170.0);
  CHECK(at(1.1 * wave_over_length) > -60.0);
}

TEST_CASE("yaw during the ping moves the receive pattern off the transmit pattern") {
  // 3 degrees/s over 2 R / c = 132 ms at 99 m: 0.396 degrees. The level falls by the product of the two patterns so far
  // apart, over that of the patterns in place; side lobes carry what is left of the narrower one.
  for (const double width_deg : {0.5, 0.21}) {
    SidescanConfig config = plain_sidescan();
    config.channels[0].horizontal_beamwidth_rad = width_deg * kDeg;
    const Sea sea = flat();
    const double waves = array::length_in_waves_for(width_deg * kDeg);
    const auto rest = received(config, sea).ping, turning = received(config, sea, 3 * kDeg).ping;
    for (const double range_m : {50.0, 98.0}) {
      const double turn = std::cos(std::asin(10.0 / range_m)) * 3 * kDeg * 2.0 * range_m / 1500.0;
      double apart = 0.0, in_place = 0.0;
      for (double u = -0.05; u <= 0.05; u += 1e-5) {
        apart += array::line_power(waves, u) * array::line_power(waves, u - turn);
        in_place += std::pow(array::line_power(waves, u), 2);
      }
      INFO(width_deg << " degrees at " << range_m << " m, expected " << 10 * std::log10(apart / in_place));
      CHECK_THAT(level_db(turning, 1, range_m, 1.5) - level_db(rest, 1, range_m, 1.5),
                 WithinAbs(10.0 * std::log10(apart / in_place), 0.5));
    }
    config.effects.motion = false;
    CHECK_THAT(level_db(received(config, sea, 3 * kDeg).ping, 1, 98), WithinAbs(level_db(rest, 1, 98), 1e-4));
  }
}

TEST_CASE("the first bottom is at the altitude, to a sample, and reported for each side") {
  SidescanConfig config = plain_sidescan();
  config.effects = {};
  config.effects.multipath = false;
  const auto [ping, bottom] = received(config, flat());
  const double sample_m = 750.0 * ping.sample_period_s;
  CHECK(bottom.valid);
  CHECK_THAT(bottom.altitude_m, WithinAbs(10.0, sample_m));
  CHECK(bottom.travel_time_s == Approx(bottom.altitude_m / 750.0));
  CHECK(bottom.quality_db > 20.0);
  for (const float side_s : bottom.beam_travel_time_s.flat()) {
    CHECK_THAT(750.0 * double(side_s), WithinAbs(10.0, 1.5 * sample_m));
  }
  // The instrument takes 1600 m/s for granted: its altitude is wrong by that, though nothing in the water changed.
  config.sound_speed_mps = 1600.0;
  CHECK_THAT(received(config, flat()).bottom.altitude_m, WithinAbs(10.0 * 1600.0 / 1500.0, 1.1 * sample_m));
}

TEST_CASE("the surface overhead is not detected as the bottom, even with a long pulse") {
  // 1 ms fill 0.75 m, more than 0.7 of the metre that the bottom has to answer for.
  for (const double samples : {2.0, 20.0}) {
    SidescanConfig config;
    config.world = plain_sidescan().world;
    config.channels[0].pulse_length_s = 1e-3;
    config.channels[0].samples_per_pulse = samples;
    const auto [ping, bottom] = received_by(Sidescan(config, 0), config, flat(-13.0), yawing(0.0, 3.0));
    INFO(samples << " samples per pulse");
    CHECK(bottom.valid);
    CHECK_THAT(bottom.altitude_m, WithinAbs(10.0, 750.0 * ping.sample_period_s + 0.02));
  }
}

TEST_CASE("a wall throws the shadow that its height says, to a sample") {
  // A ridge 2 m high from 30 m to 30.5 m east, 10 m below the head: its far upper edge shades a slant range of
  // R H / (H - h) behind it, R = sqrt(30.5^2 + 8^2), scaled to the level of the seabed.
  SidescanConfig config = plain_sidescan();
  config.channels[0].range_m = 60.0;
  config.channels[0].horizontal_beamwidth_rad = 0.1 * kDeg;  // patches of seabed of 4 mm, a ninth of a sample
  const Sea sea(tile_of(256, 0.25, [](double east, double) {
    const double seabed = -kDepth_m - 10.0;
    return east > 29.9 && east < 30.6 ? seabed + 2.0 : seabed;
  }));
  const auto ping = received(config, sea).ping;
  const double edge_m = std::hypot(30.5, 8.0), end_m = edge_m * 10.0 / 8.0;
  const double sample_m = 750.0 * ping.sample_period_s;
  const auto side = ping.amplitude_upa.row(1);
  const auto range_of = [&](std::size_t k) { return sample_m * static_cast<double>(k); };
  std::size_t first = 0, last = 0;  // silent samples: the shadow
  for (std::size_t k = 0; k < side.size(); ++k) {
    if (range_of(k) < 31.0 || range_of(k) > 50.0 || side[k] > 0.01F * side[static_cast<std::size_t>(45.0 / sample_m)])
      continue;
    if (first == 0) first = k;
    last = k;
  }
  REQUIRE(first > 0);
  // The last echo of the edge rings for a pulse, which is two samples; the far end starts with the first new echo. A
  // patch that is cut by the shadow's border answers from anywhere in its 4 mm.
  CHECK_THAT(range_of(first), WithinAbs(edge_m + 0.075, sample_m + 0.005));
  CHECK_THAT(range_of(last), WithinAbs(end_m, sample_m + 0.005));
  CHECK(level_db(ping, 0, 35) > level_db(ping, 1, 35) + 100.0);  // the other side has none
}

TEST_CASE("noise is that of the water against the line's directivity, in the pulse's band") {
  SidescanConfig config = plain_sidescan();
  config.effects.noise = true;
  config.channels[0].source_level_db = -300.0;
  world_of(config).water.noise_level_db = 50.0;
  const auto ping = received(config, flat()).ping;
  const double di =
      array::directivity_index_db(array::length_in_waves_for(0.5 * kDeg), array::length_in_waves_for(50 * kDeg));
  double sum = 0.0;
  for (const float a : ping.amplitude_upa.flat()) sum += double(a) * a;
  // 5300 samples of exponential power: the mean has a standard deviation of 0.06 dB.
  CHECK_THAT(10 * std::log10(sum / ping.amplitude_upa.size()), WithinAbs(50.0 + 40.0 - di, 0.25));
}

TEST_CASE("a run that differs in one effect differs by that effect only") {
  SidescanConfig config = plain_sidescan();
  config.effects = {};
  world_of(config).water.scattering_layers = {{13.0, 20.0, -60.0}};
  config.channels[0].range_m = 30.0;
  const Sea sea = flat();
  const auto all = received(config, sea).ping;
  CHECK(received(config, sea).ping.amplitude_upa == all.amplitude_upa);  // the same ping twice
  // Without noise the water column holds the volume's draws alone, and the other way round: powers add up in the mean,
  // and each is the same whatever else is on.
  const auto without = [&](bool Effects::*effect) {
    SidescanConfig one = config;
    one.effects.*effect = false;
    return received(one, sea).ping;
  };
  const auto quiet = without(&Effects::noise), clear = without(&Effects::volume);
  CHECK_FALSE(quiet.amplitude_upa == all.amplitude_upa);
  CHECK_FALSE(clear.amplitude_upa == all.amplitude_upa);
  SidescanConfig mute = config;
  mute.channels[0].source_level_db = -300.0;
  SidescanConfig mute_clear = mute;
  mute_clear.effects.volume = mute_clear.effects.speckle = mute_clear.effects.multipath = false;
  CHECK(received(mute, sea).ping.amplitude_upa == received(mute_clear, sea).ping.amplitude_upa);  // the noise alone
  // Switches that concern nothing in this scene change not a bit.
  CHECK(without(&Effects::refraction).amplitude_upa == all.amplitude_upa);
  CHECK(without(&Effects::quantisation).amplitude_upa == all.amplitude_upa);
  CHECK(without(&Effects::tvg).amplitude_upa == all.amplitude_upa);
  CHECK(without(&Effects::motion).amplitude_upa == all.amplitude_upa);
}

TEST_CASE("counts hold the gain, and its settings and scale give the pressure back") {
  SidescanConfig config = plain_sidescan();
  const auto pressure = received(config, flat()).ping;
  config.converter = {16, 1e9};
  config.gain_spreading_db = 30.0;
  config.gain_absorption_dbpm = 0.1;
  config.gain_offset_db = 10.0;
  const auto counts = received(config, flat()).ping;
  REQUIRE(counts.amplitude_upa.empty());
  REQUIRE(counts.amplitude_count.cols() == pressure.amplitude_upa.cols());
  for (const double range_m : {20.0, 50.0, 99.0}) {
    const auto k = static_cast<std::size_t>(range_m / (750.0 * counts.sample_period_s));
    const double gain_db = counts.applied.gain_spreading_db * std::log10(range_m) +
                           2.0 * counts.applied.gain_absorption_dbpm * range_m + counts.applied.gain_offset_db;
    const double upa = counts.amplitude_count(1, k) * counts.count_upa * std::pow(10.0, -gain_db / 20);
    // The gain of the sample differs from that of the range by half a sample; half a count of some thousand.
    CHECK_THAT(20 * std::log10(upa / pressure.amplitude_upa(1, k)), WithinAbs(0.0, 0.05));
  }
  config.effects.tvg = config.effects.quantisation = false;
  const auto off = received(config, flat()).ping;
  CHECK(off.amplitude_upa == pressure.amplitude_upa);
  CHECK(off.applied.gain_spreading_db == 0.0);
}
