#include "components/view/ping_view.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace ensonify;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double kSpeed_mps = 1500.0;

/// Three beams of samples 1 ms apart, all of 100 uPa: 40 dB.
msg::Ping even_ping(std::size_t samples) {
  msg::Ping ping;
  ping.ping = 7;
  ping.kind = "multibeam";
  ping.sample_period_s = 1e-3;
  ping.first_sample_s = 2e-3;
  ping.applied.sound_speed_mps = kSpeed_mps;
  ping.beam_angle_rad = msg::Array<float>::of({-0.5F, 0.0F, 0.5F});
  ping.amplitude_upa = msg::Array<float>({3, samples});
  for (float& value : ping.amplitude_upa.flat()) value = 100.0F;
  return ping;
}

double level_of(const msg::View& view, std::size_t beam, std::size_t cell) {
  REQUIRE(view.level(beam, cell) > 0);
  return view.level_floor_db + (view.level(beam, cell) - 1) * view.level_step_db;
}

}  // namespace

TEST_CASE("a cell's level is the mean of its samples' powers, within a quarter of a decibel") {
  msg::Ping ping = even_ping(64);
  for (std::size_t i = 0; i < 64; ++i) ping.amplitude_upa(1, i) = 10.0F * std::pow(1.13F, static_cast<float>(i));
  const msg::View view = view_of(ping, "down", {16, false});
  REQUIRE(view.level.shape() == std::vector<std::size_t>{3, 16});
  for (std::size_t cell = 0; cell < 16; ++cell) {
    double mean = 0.0;
    for (std::size_t i = 4 * cell; i < 4 * cell + 4; ++i) mean += std::pow(ping.amplitude_upa(1, i), 2.0) / 4.0;
    CHECK_THAT(level_of(view, 1, cell), WithinAbs(10.0 * std::log10(mean), 0.2501));
    CHECK_THAT(level_of(view, 0, cell), WithinAbs(40.0, 1e-9));
  }
}

TEST_CASE("with peak a cell has its strongest sample") {
  msg::Ping ping = even_ping(64);
  ping.amplitude_upa(2, 21) = 1e4F;
  CHECK_THAT(level_of(view_of(ping, "down", {16, true}), 2, 5), WithinAbs(80.0, 1e-9));
  CHECK_THAT(level_of(view_of(ping, "down", {16, false}), 2, 5), WithinAbs(80.0 - 6.02, 0.25));
}

TEST_CASE("a cell's edges enclose its samples") {
  const msg::View view = view_of(even_ping(50), "down", {16, false});  // 4 samples a cell, the thirteenth holds 2
  CHECK(view.level.cols() == 13);
  CHECK_THAT(view.cell_m, WithinAbs(4 * 0.75, 1e-12));
  CHECK_THAT(view.first_range_m, WithinAbs(1.5 - 0.375, 1e-12));
  CHECK_THAT(level_of(view, 0, 12), WithinAbs(40.0, 1e-9));
}

TEST_CASE("counts give the levels of the pressures that they stand for") {
  msg::Ping ping = even_ping(100);
  ping.applied.gain_spreading_db = 30.0;
  ping.applied.gain_absorption_dbpm = 0.05;
  ping.applied.gain_offset_db = -12.0;
  ping.count_upa = 0.01;
  ping.amplitude_upa = {};
  ping.amplitude_count = msg::Array<std::uint16_t>({3, 100});
  for (std::size_t i = 0; i < 100; ++i) {
    const double range_m = std::max(1.0, (2.0 + static_cast<double>(i)) * 0.75);
    const double gain_db = 30.0 * std::log10(range_m) + 0.1 * range_m - 12.0;
    ping.amplitude_count(1, i) = static_cast<std::uint16_t>(std::lround(100.0 * std::pow(10.0, gain_db / 20.0) / 0.01));
  }
  const msg::View view = view_of(ping, "down", {1024, false});
  CHECK_THAT(level_of(view, 1, 0), WithinAbs(40.0, 0.26));
  CHECK(view.level(0, 0) == 0);
  // Later counts are beyond 16 bits.
  for (std::size_t i = 0; i < 8; ++i) CHECK_THAT(level_of(view, 1, i), WithinAbs(40.0, 0.26));
}

TEST_CASE("the gain that is wished is added by each sample's range") {
  const msg::View view = view_of(even_ping(200), "down", {1024, false, 30.0, 0.02});
  for (const std::size_t i : {0U, 7U, 199U}) {
    const double range_m = (2.0 + static_cast<double>(i)) * 0.75;
    CHECK_THAT(level_of(view, 0, i), WithinAbs(40.0 + 30.0 * std::log10(range_m) + 0.04 * range_m, 0.2501));
  }
  CHECK(view.added_spreading_db == 30.0);
}

TEST_CASE("what is not received is 0, what is far below the highest level stands at the floor") {
  msg::Ping ping = even_ping(16);
  ping.amplitude_upa(0, 3) = 0.0F;
  ping.amplitude_upa(0, 4) = std::numeric_limits<float>::quiet_NaN();
  ping.amplitude_upa(1, 5) = 1e9F;   // 180 dB
  ping.amplitude_upa(1, 6) = 1e-3F;  // -60 dB
  const msg::View view = view_of(ping, "down", {16, false});
  CHECK(view.level(0, 3) == 0);
  CHECK(view.level(0, 4) == 0);
  CHECK_THAT(level_of(view, 1, 5), WithinAbs(180.0, 1e-9));
  CHECK(view.level(1, 6) == 1);
  CHECK(view.level_floor_db == 60.0);

  for (float& value : ping.amplitude_upa.flat()) value = 0.0F;
  const msg::View silent = view_of(ping, "down", {16, false});
  for (const std::uint8_t value : silent.level.flat()) CHECK(value == 0);
}

TEST_CASE("a ping without picture says why") {
  msg::Ping ping = even_ping(16);
  ping.applied.sound_speed_mps = 0.0;
  CHECK_THROWS_WITH(view_of(ping, "down", {}), Contains("sound_speed_mps must be above 0"));
  ping = even_ping(16);
  ping.beam_angle_rad = msg::Array<float>::of({0.0F});
  CHECK_THROWS_WITH(view_of(ping, "down", {}), "amplitudes (3 x 16) do not fit 1 beam angles");
  ping = even_ping(16);
  ping.amplitude_upa = msg::Array<float>({48});
  CHECK_THROWS_WITH(view_of(ping, "down", {}), Contains("not beam x sample"));
  ping.amplitude_upa = {};
  CHECK_THROWS_WITH(view_of(ping, "down", {}), "no samples were published with this ping");
}

TEST_CASE("a picture becomes narrower, and gets its gain, as if it were made anew of the ping") {
  msg::Ping ping = even_ping(640);
  for (std::size_t i = 0; i < 640; ++i)
    ping.amplitude_upa(1, i) = 100.0F * (1.0F + 0.9F * std::sin(0.13F * static_cast<float>(i)));
  const msg::View fine = view_of(ping, "down", {640, false});
  const PictureWish wish{40, false, 30.0, 0.02};
  const msg::View made = view_as(fine, wish);
  const msg::View anew = view_of(ping, "down", wish);
  REQUIRE(made.level.shape() == anew.level.shape());
  CHECK(made.cell_m == anew.cell_m);
  CHECK(made.first_range_m == anew.first_range_m);
  CHECK(made.added_spreading_db == 30.0);
  CHECK(made.added_absorption_dbpm == 0.02);
  for (std::size_t beam = 0; beam < 3; ++beam)
    for (std::size_t cell = 0; cell < 40; ++cell)
      CHECK_THAT(level_of(made, beam, cell), WithinAbs(level_of(anew, beam, cell), 0.5001));
  CHECK(view_as(fine, {1024, false}).level.shape() == fine.level.shape());
}

TEST_CASE("on the ground a target lies nearer than along the ray, and the water column is gone") {
  msg::Ping ping = even_ping(100);
  ping.first_sample_s = 0.0;
  const std::size_t target = 40;  // 30 m of slant range; 18 m above the seabed that is 24 m on the ground
  ping.amplitude_upa(1, target) = 1e4F;
  const msg::View view = view_of(ping, "down", {1024, false});
  const msg::View ground = on_ground(view, 18.0);
  CHECK(ground.ground_altitude_m == 18.0);
  CHECK(ground.first_range_m == 0.0);
  std::vector<double> ranges_m;
  for (std::size_t i = 0; i < ground.level.cols(); ++i)
    if (ground.level(1, i) > 0 && level_of(ground, 1, i) > 70.0)
      ranges_m.push_back((static_cast<double>(i) + 0.5) * ground.cell_m);
  REQUIRE_FALSE(ranges_m.empty());
  for (const double range_m : ranges_m) CHECK_THAT(range_m, WithinAbs(24.0, ground.cell_m));
  CHECK(ground.level(0, 0) > 0);                         // the seabed straight below
  CHECK(ground.level(0, ground.level.cols() - 1) == 0);  // its slant range is beyond the last
  CHECK(on_ground(view, 0.0).ground_altitude_m == 0.0);
}

TEST_CASE("valid detections stand at their ranges") {
  msg::Soundings soundings;
  soundings.valid = msg::Array<std::uint8_t>::of({1, 0, 1, 1});
  soundings.beam_angle_rad = msg::Array<float>::of({-0.5F, 0.0F, 0.25F, 0.5F});
  soundings.travel_time_s = msg::Array<float>::of({0.02F, 0.02F, 0.04F, std::numeric_limits<float>::quiet_NaN()});
  soundings.kind = msg::Array<std::uint8_t>::of({1, 0, 2, 1});
  soundings.applied.sound_speed_mps = kSpeed_mps;
  msg::View view;
  add_finds(view, soundings);
  REQUIRE(view.find_range_m.size() == 2);
  CHECK_THAT(static_cast<double>(view.find_range_m[0]), WithinAbs(15.0, 1e-5));
  CHECK_THAT(static_cast<double>(view.find_range_m[1]), WithinAbs(30.0, 1e-5));
  CHECK(view.find_angle_rad[1] == 0.25F);
  CHECK(view.find_kind[1] == 2);
}
