#include "kernels/acoustics/array/stabilisation.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/acoustics/array/line.h"
#include "kernels/base/random/stream.h"

using namespace ensonify;
using namespace ensonify::array;
using Catch::WithinAbs;
using frames::Attitude;
using frames::Quaternion;
using frames::Vec3;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDeg = kPi / 180.0;
const Stabilisation kAll{.pitch = true, .yaw = true, .roll = true};

/// Where the beam of both cones really is: across-track angle from the vertical, rad.
double true_across_rad(const Attitude& at_transmit, double sin_transmit, const Attitude& at_receive,
                       double sin_receive) {
  const Quaternion level_from_head_transmit = held_from_head(kAll, at_transmit, 0.0);
  const Quaternion level_from_head_receive = held_from_head(kAll, at_receive, 0.0);
  const auto direction = cone_intersection(level_from_head_transmit * Vec3::UnitX(), sin_transmit,
                                           level_from_head_receive * Vec3::UnitY(), sin_receive);
  REQUIRE(direction);
  return std::atan2(direction->y(), direction->z());
}

/// A ship's motion: sines of time.
struct Motion {
  double roll_rad, roll_period_s, pitch_rad, pitch_period_s;

  Attitude at(double t_s) const {
    return {.pitch_rad = pitch_rad * std::sin(2.0 * kPi * t_s / pitch_period_s + 1.0),
            .roll_rad = roll_rad * std::sin(2.0 * kPi * t_s / roll_period_s)};
  }
  double largest_roll_rate_radps() const { return roll_rad * 2.0 * kPi / roll_period_s; }
};

}  // namespace

TEST_CASE("a head that is level and unstabilised steers to the sine of the angle") {
  const Quaternion q = held_from_head({.pitch = false, .yaw = false, .roll = false},
                                      {.heading_rad = 1.0, .pitch_rad = 0.2, .roll_rad = -0.3}, 0.5);
  CHECK(q.angularDistance(Quaternion::Identity()) < 1e-12);
  CHECK(across_sine(q, direction_held(0.7)) == Approx(std::sin(0.7)));
  CHECK(transmit_sine(q, direction_held(0.7, 0.05)) == Approx(std::sin(0.05)));
}

TEST_CASE("roll adds to the beam angle, pitch takes from the tilt, yaw turns the outer fan") {
  const double roll = 0.15, pitch = 0.1, yaw = 0.05;
  // Starboard down: a beam to starboard of the vertical is nearer to the head's starboard axis.
  CHECK(across_sine(held_from_head(kAll, {.roll_rad = roll}, 0.0), direction_held(0.6)) ==
        Approx(std::sin(0.6 + roll)));
  // Bow up: the fan has to point aft of the head's z axis.
  CHECK(transmit_sine(held_from_head(kAll, {.pitch_rad = pitch}, 0.0), direction_held(0.0)) ==
        Approx(-std::sin(pitch)));
  // Bow to starboard of the reference: a direction abeam to starboard is forward in the head.
  CHECK(transmit_sine(held_from_head(kAll, {.heading_rad = 1.0 + yaw}, 1.0), direction_held(0.5)) ==
        Approx(std::sin(yaw) * std::sin(0.5)));
  CHECK_THAT(transmit_sine(held_from_head({.yaw = false}, {.heading_rad = 1.0 + yaw}, 1.0), direction_held(0.5)),
             WithinAbs(0.0, 1e-15));
}

TEST_CASE("with a perfect sensor and no delay every beam is steered right at any attitude") {
  const random::Stream draw{7, "attitudes"};
  for (std::uint64_t i = 0; i < 200; ++i) {
    const auto angle = [&](std::uint64_t k, double limit_deg) {
      return (2.0 * draw.uniform(i, k) - 1.0) * limit_deg * kDeg;
    };
    const Attitude transmit{.heading_rad = angle(0, 5), .pitch_rad = angle(1, 10), .roll_rad = angle(2, 10)};
    const Attitude receive{.heading_rad = angle(3, 5), .pitch_rad = angle(4, 10), .roll_rad = angle(5, 10)};
    const double across = angle(6, 65), centre = angle(7, 40);
    const Quaternion at_transmit = held_from_head(kAll, transmit, 0.0);
    const double sin_transmit = transmit_sine(at_transmit, direction_held(centre));
    const auto fan = fan_direction(at_transmit, sin_transmit, across);
    REQUIRE(fan);
    CHECK(fan->norm() == Approx(1.0));
    CHECK_THAT(transmit_sine(at_transmit, *fan), WithinAbs(sin_transmit, 1e-12));
    CHECK_THAT(std::atan2(fan->y(), fan->z()), WithinAbs(across, 1e-12));
    const double sin_receive = across_sine(held_from_head(kAll, receive, 0.0), *fan);
    CHECK_THAT(true_across_rad(transmit, sin_transmit, receive, sin_receive), WithinAbs(across, 1e-9));
    CHECK_THAT(fan_direction(at_transmit, sin_transmit, centre)->x(), WithinAbs(0.0, 1e-12));  // vertical at its centre
  }
}

TEST_CASE("at 10 degrees of roll sector edges err by sensor error plus latency times rate") {
  const Motion motion{.roll_rad = 10 * kDeg, .roll_period_s = 6.0, .pitch_rad = 0.0, .pitch_period_s = 5.0};
  const random::Stream draw{3, "pings"};
  for (const double latency_s : {0.0, 0.005, 0.02, 0.1}) {
    for (const double error_rad : {0.0, 0.02 * kDeg, -0.1 * kDeg}) {
      const double bound = std::abs(error_rad) + latency_s * motion.largest_roll_rate_radps();
      const auto measured = [&](double t_s) {
        Attitude attitude = motion.at(t_s - latency_s);
        attitude.roll_rad += error_rad;
        return attitude;
      };
      double worst = 0.0, worst_sent = 0.0;
      for (std::uint64_t ping = 0; ping < 300; ++ping) {
        const double transmit_s = 60.0 * draw.uniform(ping, 0), receive_s = transmit_s + 0.3 * draw.uniform(ping, 1);
        const Quaternion estimated = held_from_head(kAll, measured(transmit_s), 0.0);
        const double sin_transmit = transmit_sine(estimated, direction_held(0.0));
        for (const double edge : {-65 * kDeg, 65 * kDeg}) {
          const auto wanted = fan_direction(estimated, sin_transmit, edge);
          REQUIRE(wanted);
          const double sin_receive = across_sine(held_from_head(kAll, measured(receive_s), 0.0), *wanted);
          const double got = true_across_rad(motion.at(transmit_s), sin_transmit, motion.at(receive_s), sin_receive);
          worst = std::max(worst, std::abs(got - edge));
          // The edge of a transmit sector: the same, but by what was measured at transmission.
          const double sent = true_across_rad(motion.at(transmit_s), sin_transmit, motion.at(transmit_s),
                                              across_sine(estimated, *wanted));
          worst_sent = std::max(worst_sent, std::abs(sent - edge));
        }
      }
      INFO("latency " << latency_s << " s, error " << error_rad / kDeg << " deg");
      CHECK(worst <= bound + 1e-12);
      CHECK(worst_sent <= bound + 1e-12);
      CHECK(std::min(worst, worst_sent) >= 0.9 * bound);  // 300 random pings come near the steepest roll
    }
  }
}

TEST_CASE("with pitch too the edges stay within the same bound to 2 percent") {
  // The roll axis is then tilted by the pitch and the fan's cone is not a vertical plane: second order in the pitch.
  const Motion motion{.roll_rad = 10 * kDeg, .roll_period_s = 6.0, .pitch_rad = 5 * kDeg, .pitch_period_s = 4.3};
  const double latency_s = 0.02, error_rad = 0.05 * kDeg;
  const double bound = error_rad + latency_s * motion.largest_roll_rate_radps();
  const random::Stream draw{4, "pings"};
  double worst = 0.0;
  for (std::uint64_t ping = 0; ping < 500; ++ping) {
    const double transmit_s = 60.0 * draw.uniform(ping, 0), receive_s = transmit_s + 0.3 * draw.uniform(ping, 1);
    const auto measured = [&](double t_s) {  // roll late and wrong, pitch right
      return Attitude{.pitch_rad = motion.at(t_s).pitch_rad,
                      .roll_rad = motion.at(t_s - latency_s).roll_rad + error_rad};
    };
    const Quaternion estimated = held_from_head(kAll, measured(transmit_s), 0.0);
    const double sin_transmit = transmit_sine(estimated, direction_held(0.0));
    for (const double edge : {-65 * kDeg, 65 * kDeg}) {
      const double sin_receive =
          across_sine(held_from_head(kAll, measured(receive_s), 0.0), *fan_direction(estimated, sin_transmit, edge));
      worst = std::max(
          worst,
          std::abs(true_across_rad(motion.at(transmit_s), sin_transmit, motion.at(receive_s), sin_receive) - edge));
    }
  }
  CHECK(worst <= 1.02 * bound);
  CHECK(worst >= 0.9 * bound);
}

TEST_CASE("cones without intersection give no direction, a beam on the y-z plane no x") {
  CHECK_FALSE(cone_intersection(Vec3::UnitX(), 0.8, Vec3::UnitY(), 0.8));
  const auto direction = cone_intersection(Vec3::UnitX(), 0.0, Vec3::UnitY(), std::sin(0.4));
  REQUIRE(direction);
  CHECK((*direction - direction_held(0.4)).norm() < 1e-15);
  CHECK_FALSE(fan_direction(Quaternion::Identity(), 1.5, 0.0));
}

TEST_CASE("a wrong sound speed at the face turns beams as Snell says") {
  CHECK(true_sine(std::sin(60 * kDeg), 1500.0, 1515.0) == Approx(std::sin(60 * kDeg) * 1.01));
  // The same from the pattern: phases for 1500 m/s, waves of 1515 m/s. The peak is where the phases match.
  const double frequency_hz = 300e3;
  const LineArray line{.spacing_m = 0.0025, .weights = shading_weights({}, 128)};
  const double commanded = std::sin(60 * kDeg);
  const auto received = [&](double u) {  // phases are k_used x commanded = k_true x (commanded true / used)
    return power(line, 1515.0 / frequency_hz, u, true_sine(commanded, 1500.0, 1515.0));
  };
  std::complex<double> sum = 0.0;
  const double at = commanded * 1.01 + 0.003;
  for (int n = 0; n < 128; ++n) {
    const double x = 0.0025 * (n - 63.5);
    sum += std::polar(1.0 / 128.0, 2.0 * kPi * frequency_hz * x * (at / 1515.0 - commanded / 1500.0));
  }
  CHECK(received(at) == Approx(std::norm(sum)).epsilon(1e-9));
}
