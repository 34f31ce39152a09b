#include "components/multibeam/steering.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "components/multibeam/ping_message.h"
#include "components/multibeam/testing/head.h"
#include "kernels/acoustics/array/stabilisation.h"

using namespace ensonify;
using Catch::WithinAbs;
using frames::Vec3;

namespace {

constexpr double kDegree = MultibeamConfig::kDegree;

/// Angle from the vertical across the track at which a beam lies, with the head turned like this.
double across_rad(const Steering& steering, std::size_t beam, const frames::Attitude& attitude,
                  std::optional<double> mean_heading_rad = {}) {
  frames::Attitude counted = attitude;
  counted.heading_rad = mean_heading_rad ? attitude.heading_rad - *mean_heading_rad : 0.0;
  const frames::Quaternion level_from_head = frames::enu_from_ned().conjugate() * frames::enu_from_body(counted);
  const auto direction = array::cone_intersection(
      level_from_head * Vec3::UnitX(), steering.sectors[steering.beam_sector[beam]].sin_transmit,
      level_from_head * Vec3::UnitY(), static_cast<double>(steering.sin_beams[beam]));
  return std::atan2(direction->y(), direction->z());
}

}  // namespace

TEST_CASE("stabilised beams keep their angles from the vertical, whatever roll and pitch") {
  const MultibeamConfig config = head_in_plain_water();
  for (const double roll_deg : {-10.0, 0.0, 10.0}) {
    for (const double pitch_deg : {-4.0, 0.0, 4.0}) {
      const frames::Attitude attitude{1.0, pitch_deg * kDegree, roll_deg * kDegree};
      const Steering steering = steer(config, config.swath_rad, {1500.0, attitude});
      CHECK((steering.roll_stabilised && steering.pitch_stabilised));
      for (const std::size_t beam : {0U, 60U, 128U, 255U}) {  // of a float sine at 75 degrees: 2e-7
        CHECK_THAT(across_rad(steering, beam, attitude),
                   WithinAbs(static_cast<double>(steering.across_rad[beam]), 1e-6));
      }
    }
  }
}

TEST_CASE("without stabilisation or motion sensor, angles count from the head's axis") {
  MultibeamConfig config = head_in_plain_water();
  const auto unsteered = [](const Steering& s) {
    return s.sectors[0].sin_transmit == 0.0 && s.sectors[0].middle_rad == 0.0 && !s.roll_stabilised &&
           !s.pitch_stabilised && std::abs(s.beam_angle_rad[255] - static_cast<float>(65.0 * kDegree)) < 1e-6F;
  };
  CHECK(unsteered(steer(config, config.swath_rad, {1500.0, std::nullopt})));
  config.roll_stabilised = config.pitch_stabilised = false;
  CHECK(unsteered(steer(config, config.swath_rad, {1500.0, frames::Attitude{0.0, 0.1, 0.1}})));
}

TEST_CASE("a single transmission states its tilt where it is steered against pitch, and is no list where straight") {
  const MultibeamConfig config = head_in_plain_water();
  const auto applied = [&](const std::optional<frames::Attitude>& attitude) {
    return applied_settings(config, {}, {}, steer(config, config.swath_rad, {1500.0, attitude}));
  };
  const msg::AppliedSettings pitched = applied(frames::Attitude{0.0, 0.05, 0.0});
  REQUIRE(pitched.sectors.size() == 1);
  CHECK_THAT(pitched.sectors[0].tilt_rad, WithinAbs(-0.05, 1e-9));  // bow up: backward to the vertical
  CHECK(pitched.sectors[0].frequency_hz == config.frequency_hz);
  CHECK(applied(std::nullopt).sectors.empty());
}

TEST_CASE("a beam is never steered behind the face") {
  MultibeamConfig config = head_in_plain_water();
  config.swath_rad = 170.0 * kDegree;
  const Steering steering = steer(config, config.swath_rad, {1500.0, frames::Attitude{0.0, 0.0, 15.0 * kDegree}});
  for (const float sine : steering.sin_beams) CHECK(std::abs(sine) <= 1.0F);
  CHECK(std::ranges::is_sorted(steering.sin_beams));
}

TEST_CASE("each sector's fan passes through the middle of its part of the swath") {
  MultibeamConfig config = head_in_plain_water();
  config.sectors = {
      {.frequency_hz = 300e3, .tilt_rad = 0.02}, {.share = 2.0, .frequency_hz = 300e3}, {.frequency_hz = 300e3}};
  config.yaw_stabilised = true;
  const auto sectors = sectors_of(config, config.swath_rad);
  REQUIRE(sectors.size() == 3);
  CHECK(sectors[0].centre_rad == Approx(-48.75 * kDegree));
  CHECK(sectors[1].width_rad == Approx(65.0 * kDegree));
  for (const double yaw_deg : {-6.0, 0.0, 6.0}) {
    const frames::Attitude attitude{1.0 + yaw_deg * kDegree, 2.0 * kDegree, -3.0 * kDegree};
    const Steering steering = steer(config, config.swath_rad, {1500.0, attitude, 1.0});
    frames::Attitude from_mean = attitude;
    from_mean.heading_rad -= 1.0;
    const frames::Quaternion level_from_head = frames::enu_from_ned().conjugate() * frames::enu_from_body(from_mean);
    for (std::size_t i = 0; i < 3; ++i) {
      const double a = sectors[i].centre_rad, t = sectors[i].tilt_rad;
      const Vec3 middle(std::sin(t), std::cos(t) * std::sin(a), std::cos(t) * std::cos(a));
      CHECK_THAT((level_from_head * Vec3::UnitX()).dot(middle), WithinAbs(steering.sectors[i].sin_transmit, 1e-12));
    }
    // Every beam lies in its sector's edges, and at its angle from the vertical.
    for (std::size_t beam = 0; beam < 256; ++beam) {
      const SteeredSector& sector = steering.sectors[steering.beam_sector[beam]];
      CHECK(static_cast<double>(steering.sin_beams[beam]) >= sector.lower_sine - 1e-6);
      CHECK(static_cast<double>(steering.sin_beams[beam]) <= sector.upper_sine + 1e-6);
      CHECK_THAT(across_rad(steering, beam, attitude, 1.0),
                 WithinAbs(static_cast<double>(steering.across_rad[beam]), 1e-5));
    }
  }
}

TEST_CASE("in a turn the fans lag the heading by ten degrees at most") {
  MultibeamConfig config = head_in_plain_water();
  config.sectors = {{.frequency_hz = 300e3}, {.frequency_hz = 300e3}, {.frequency_hz = 300e3}};
  config.yaw_stabilised = true;
  const auto sines = [&](double yaw_deg, double mean_rad) {
    const frames::Attitude attitude{frames::wrap_two_pi(mean_rad + yaw_deg * kDegree), 0.0, 0.0};
    const Steering steering = steer(config, config.swath_rad, {1500.0, attitude, mean_rad});
    return std::array{steering.sectors[0].sin_transmit, steering.sectors[2].sin_transmit};
  };
  for (const double mean_rad : {1.0, 0.05}) {
    for (const double sign : {-1.0, 1.0}) {
      const auto limit = sines(sign * 10.0, mean_rad);
      CHECK_THAT(std::abs(limit[0]), WithinAbs(std::sin(10.0 * kDegree) * std::sin(43.333 * kDegree), 1e-4));
      for (const double yaw_deg : {30.0, 90.0, 170.0}) {
        const auto turned = sines(sign * yaw_deg, mean_rad);
        CHECK_THAT(turned[0], WithinAbs(limit[0], 1e-9));
        CHECK_THAT(turned[1], WithinAbs(limit[1], 1e-9));
      }
      CHECK(std::abs(sines(sign * 5.0, mean_rad)[0]) < 0.6 * std::abs(limit[0]));
    }
  }
}

TEST_CASE("the mean heading follows slowly, the short way round") {
  HeadingMean mean(10.0);
  mean.update(0.0, 6.2);
  CHECK(mean.mean_rad() == 6.2);
  for (int i = 1; i <= 100; ++i) mean.update(0.1 * i, 0.1);  // 0.183 rad further, through north
  const double turned = 0.1 - (6.2 - 2.0 * std::acos(-1.0));
  CHECK_THAT(mean.mean_rad(), WithinAbs(6.2 + turned * (1.0 - std::exp(-1.0)), 1e-9));
}
