#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "components/forward_looking/head.h"
#include "components/multibeam/ping_message.h"
#include "components/multibeam/testing/head.h"
#include "components/sonar/testing/ping.h"
#include "components/sonar/tile_set.h"
#include "kernels/acoustics/array/line.h"
#include "tests/physics/dip.h"
#include "tests/physics/sidescan_ping.h"
#include "tests/physics/strips.h"

// Two bright strips of a dark level seabed through whole heads, rays and patches of seabed included.
// resolution_test.cpp has the same for points and kernels.

using namespace ensonify;
using namespace ensonify::physics;
using Catch::WithinAbs;

namespace {

constexpr double kAltitude_m = 10.0, kSpeed_mps = 1500.0;
constexpr double kPulse_s = 100e-6, kCell_m = 0.5 * kSpeed_mps * kPulse_s;
constexpr double kSixPerPulse = 6.0, kEightPerPulse = 8.0;
constexpr double kPost_m = 0.01, kFine_m = 0.005;  // a strip is two posts wide
constexpr int kPlaces = 16;                        // between two samples

double ground_m(double slant_m, double altitude_m) { return std::sqrt(slant_m * slant_m - altitude_m * altitude_m); }

/// Two strips across the view, `apart_m` of slant range apart.
auto strips_at(double slant_m, double apart_m, double post_m, double altitude_m = kAltitude_m) {
  return [near_m = ground_m(slant_m, altitude_m), far_m = ground_m(slant_m + apart_m, altitude_m),
          post_m](double away_m) { return std::abs(away_m - near_m) < post_m || std::abs(away_m - far_m) < post_m; };
}

std::vector<double> powers_of(std::span<const float> amplitudes) {
  std::vector<double> powers;
  for (const float a : amplitudes) powers.push_back(double(a) * double(a));
  return powers;
}

frames::PoseHistory resting_at(const frames::Vec3& position_enu_m) {
  frames::PoseHistory truth(1'000'000'000);
  truth.push(0, {position_enu_m, frames::enu_from_ned()});
  return truth;
}

/// Patches of seabed are a fortieth of the beam at 100 m: 4 mm for 0.1 degrees.
SidescanConfig sidescan_over_strips(double width_deg, double range_m) {
  SidescanConfig config = sidescan_of(400e3);
  receive_strips(config);
  config.channels[0].horizontal_beamwidth_rad = width_deg * SidescanChannel::kDegree;
  config.channels[0].range_m = range_m;
  config.quality = 2.0;
  return config;
}

/// Of two strips along the track, `apart_m` of slant range apart and 50 m away.
Dips of_sidescan(const SidescanConfig& config, double apart_m) {
  constexpr double kHalf_m = 0.25, kNear_m = 50.0;
  const auto strips = strips_at(kNear_m, apart_m, kPost_m);
  TileSet tiles;
  tiles.insert(striped({kAltitude_m, kPost_m, 48.85, -kHalf_m, 49.25, kHalf_m},
                       [&](double east_m, double) { return strips(east_m); }));
  const double sample_m = 0.5 * kSpeed_mps * config.channels[0].sample_period_s();
  Dips dips;
  for (int i = 0; i < kPlaces; ++i) {
    const auto ping = sidescan_ping(config, tiles.scene(), {i * sample_m / kPlaces, 0.0, 0.0});
    dips.add(dip_db(powers_of(ping.amplitude_upa.row(1))));
  }
  return dips;
}

/// A multibeam's beam 45 degrees to starboard, over strips along the track.
Dips of_multibeam(double apart_m, double altitude_m = kAltitude_m) {
  MultibeamConfig config;
  receive_strips(config);
  config.frequency_hz = 400e3;
  config.sample_rate_hz = kEightPerPulse / kPulse_s;
  config.quality = 4.0;
  const double slant_m = std::numbers::sqrt2 * altitude_m;
  const auto strips = strips_at(slant_m, apart_m, kFine_m, altitude_m);
  TileSet tiles;
  tiles.insert(striped({altitude_m, kFine_m, altitude_m - 0.03, -0.1, altitude_m + 0.25, 0.1},
                       [&](double east_m, double) { return strips(east_m); }));
  const HeadSettings settings = config.start();
  const Steering steering = steer(config, config.swath_rad, {.sound_speed_mps = kSpeed_mps});
  const Multibeam head(config, 0);
  Dips dips;
  for (int i = 0; i < kPlaces; ++i) {
    const double sample_m = 0.5 * kSpeed_mps / config.sample_rate_hz;
    const auto truth = resting_at({std::numbers::sqrt2 * sample_m * i / kPlaces, 0.0, 0.0});
    const PingEvent event{0, SimTime{0}, slant_m + 3.0};
    Multibeam::Memory memory;
    const auto beams = receive_echoes(head, event, settings, steering, truth, tiles.scene(), memory);
    const auto ping = ping_message(config, event, settings, steering,
                                   applied_settings(config, event, settings, steering), {memory.amplitude_upa, beams});
    std::size_t beam = 0;
    while (double(ping.beam_angle_rad[beam]) < 0.25 * std::numbers::pi) ++beam;
    dips.add(dip_db(powers_of(ping.amplitude_upa.row(beam))));
  }
  return dips;
}

/// A forward-looking head's middle beam, over strips across its view.
Dips of_forward_looking(double apart_m) {
  ForwardLookingConfig config;
  receive_strips(config);
  config.pulse = {.length_s = kPulse_s, .samples_per_pulse = kEightPerPulse};
  config.tilt_rad = 0.25 * std::numbers::pi;
  config.aperture_rad = 0.35;
  config.beams = 21;
  config.range_m = 17.0;
  config.quality = 4.0;
  const auto strips = strips_at(std::numbers::sqrt2 * kAltitude_m, apart_m, kFine_m);
  TileSet tiles;
  tiles.insert(
      striped({kAltitude_m, kFine_m, -0.1, 9.97, 0.1, 10.25}, [&](double, double north_m) { return strips(north_m); }));
  ForwardLooking head(config, 0);
  Dips dips;
  for (int i = 0; i < kPlaces; ++i) {
    const double sample_m = 0.5 * kSpeed_mps * kPulse_s / kEightPerPulse;
    const auto truth = resting_at({0.0, std::numbers::sqrt2 * sample_m * i / kPlaces, 0.0});
    const auto ping =
        image_of(head, {0, SimTime{0}, config.range_m}, config.start(), around(truth, tiles.scene(), kSpeed_mps));
    dips.add(dip_db(powers_of(ping.amplitude_upa.row(static_cast<std::size_t>(config.beams) / 2))));
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
  tiles.insert(striped({kAltitude_m, kPost_m, 20.0, -kHalf_m, 31.0, kHalf_m}, bright));
  const SidescanConfig config = sidescan_over_strips(kWidth_deg, 31.0);
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

TEST_CASE("at 6 samples a pulse a sidescan resolves strips 1.2 x c tau / 2 apart, not 0.7 x") {
  // The strips are 20 mm wide in slant range, a quarter of c tau / 2: their echoes pass half
  // power where those of points in their middle end and begin, so a fifth of a pulse lies between them.
  SidescanConfig config = sidescan_over_strips(0.1, 51.0);
  config.channels[0].samples_per_pulse = kSixPerPulse;
  CHECK(of_sidescan(config, 1.2 * kCell_m).shallowest > 3.0);
  CHECK(of_sidescan(config, 0.7 * kCell_m).deepest < 1.0);
}

TEST_CASE("at 2 samples a pulse a sidescan resolves 1.65 x c tau / 2, 1.2 x only by chance") {
  const SidescanConfig config = sidescan_over_strips(0.1, 51.0);
  CHECK(of_sidescan(config, 1.65 * kCell_m).shallowest > 3.0);
  const Dips near = of_sidescan(config, 1.2 * kCell_m);
  CHECK(near.deepest > 3.0);
  CHECK(near.shallowest < 3.0);
  CHECK(of_sidescan(config, 0.7 * kCell_m).deepest < 1.0);
}

TEST_CASE("a sidescan's chirp resolves strips 1.2 x c / 2B apart anywhere, and not 0.7 x") {
  // Points dip by 3.04 dB at the instant between them (resolution_test.cpp). 20 samples per 1 / B miss it by 1 / 40 at
  // most; strips a quarter of a cell wide on posts of their own move it by half a dB either way.
  SidescanConfig config = sidescan_over_strips(0.1, 51.0);
  config.channels[0].chirp = true;
  config.channels[0].pulse_length_s = 4e-3;
  config.channels[0].bandwidth_hz = 1.0 / kPulse_s;
  config.channels[0].window = echo::Window::kNone;
  config.channels[0].samples_per_pulse = 20.0;
  const Dips two = of_sidescan(config, 1.2 * kCell_m);
  CHECK(two.shallowest > 2.5);
  CHECK(of_sidescan(config, 0.7 * kCell_m).deepest < 1.0);
}

TEST_CASE("at 8 samples a pulse a multibeam resolves strips 1.2 x c tau / 2 apart only") {
  // Patches of seabed are a quarter of c tau / 2 wide then, and answer from anywhere in them: of the fifth of a pulse
  // between points, strips leave half.
  const Dips two = of_multibeam(1.2 * kCell_m), one = of_multibeam(0.7 * kCell_m);
  CHECK(two.shallowest > 3.0);
  CHECK(one.deepest < 1.0);
  // Twice as far away patches are long along the track, and no wider. A strip that lies in two parts less: the mean
  // over places in a patch.
  constexpr int kPlacesInPatch = 4;
  double mean_db = 0.0;
  for (int k = 0; k < kPlacesInPatch; ++k)
    mean_db += of_multibeam(1.2 * kCell_m, 2.0 * kAltitude_m + 0.25 * kCell_m * k / kPlacesInPatch).shallowest /
               kPlacesInPatch;
  CHECK(mean_db > 3.5);  // twice as wide they leave 3.0
}

TEST_CASE("at reference, with eight samples a pulse, a forward-looking head parts them too") {
  const Dips two = of_forward_looking(1.2 * kCell_m), one = of_forward_looking(0.7 * kCell_m);
  CHECK(two.shallowest > 3.0);
  CHECK(one.deepest < 1.0);
}

TEST_CASE("a sidescan parts strips 1.2 beam widths apart along the track, and not 0.7") {
  // Points 1.2 one-way widths apart dip by 5.9 dB; these strips are a sixth of a width wide, and lie on posts. Some
  // hundred rays hit each: 0.3 dB.
  const AlongTrack two = along_track(1.2), one = along_track(0.7);
  CHECK(two.theory_db > 3.5);
  CHECK(two.found_db > 3.0);
  CHECK_THAT(two.found_db, WithinAbs(two.theory_db, 0.7));
  CHECK(one.found_db < 0.5);
}
