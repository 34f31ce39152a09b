#include "kernels/base/frames/attitude.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify::frames;
using Catch::WithinAbs;
constexpr double kPi = std::numbers::pi;
constexpr double kDeg = kPi / 180.0;

static void check_same(const Vec3& a, const Vec3& b) {
  INFO("got " << a.transpose() << ", want " << b.transpose());
  CHECK((a - b).norm() < 1e-12);
}

TEST_CASE("a level body with its bow to east has starboard to south and keel down") {
  const Quaternion q = enu_from_body(Attitude{90 * kDeg, 0, 0});
  check_same(q * Vec3::UnitX(), {1, 0, 0});
  check_same(q * Vec3::UnitY(), {0, -1, 0});
  check_same(q * Vec3::UnitZ(), {0, 0, -1});
}

TEST_CASE("positive pitch lifts the bow, positive roll lowers starboard") {
  CHECK((enu_from_body(Attitude{0, 10 * kDeg, 0}) * Vec3::UnitX()).z() == Approx(std::sin(10 * kDeg)));
  CHECK((enu_from_body(Attitude{0, 0, 10 * kDeg}) * Vec3::UnitY()).z() == Approx(-std::sin(10 * kDeg)));
}

TEST_CASE("attitude and rotation are inverses, and w is never negative") {
  for (double heading = 1; heading < 360; heading += 37)
    for (double pitch = -89; pitch <= 89; pitch += 22.25)
      for (double roll = -179; roll <= 180; roll += 43) {
        const Quaternion q = enu_from_body(Attitude{heading * kDeg, pitch * kDeg, roll * kDeg});
        REQUIRE(q.w() >= 0.0);
        const Attitude back = attitude_of(q);
        REQUIRE_THAT(back.heading_rad, WithinAbs(heading * kDeg, 1e-9));
        REQUIRE_THAT(back.pitch_rad, WithinAbs(pitch * kDeg, 1e-9));
        REQUIRE_THAT(back.roll_rad, WithinAbs(roll * kDeg, 1e-9));
      }
}

TEST_CASE("at the vertical the rotation is kept though heading and roll are not separable") {
  for (const double pitch : {90.0, -90.0}) {
    const Quaternion q = enu_from_body(Attitude{30 * kDeg, pitch * kDeg, 20 * kDeg});
    const Attitude back = attitude_of(q);
    CHECK(back.roll_rad == 0.0);
    CHECK(enu_from_body(back).angularDistance(q) < 1e-7);
  }
}

TEST_CASE("q and -q leave as the same four numbers") {
  const Quaternion q = enu_from_body(Attitude{200 * kDeg, 5 * kDeg, -3 * kDeg});
  const Quaternion minus_q(-q.w(), -q.x(), -q.y(), -q.z());
  CHECK(wxyz_of(q) == wxyz_of(minus_q));
  CHECK(wxyz_of(quaternion_of({2.0, 0.0, 0.0, 0.0})) == std::array<double, 4>{1.0, 0.0, 0.0, 0.0});
  CHECK(wxyz_of(Quaternion(0.0, -1.0, 0.0, 0.0)) == std::array<double, 4>{0.0, 1.0, 0.0, 0.0});
}

TEST_CASE("angles wrap to their half-open intervals") {
  CHECK(wrap_pi(3 * kPi) == Approx(kPi));
  CHECK(wrap_pi(-kPi) == kPi);
  CHECK(wrap_pi(0.5) == 0.5);
  CHECK(wrap_two_pi(-0.5) == Approx(2 * kPi - 0.5));
  CHECK(wrap_two_pi(-1e-20) == 0.0);
  CHECK(wrap_two_pi(2 * kPi) == 0.0);
}

TEST_CASE("body rates are the derivative of the rotation") {
  const Attitude a{0.7, 0.2, -0.4}, rate{0.3, -0.1, 0.25};
  const double h = 1e-6;
  const Attitude later{a.heading_rad + h * rate.heading_rad, a.pitch_rad + h * rate.pitch_rad,
                       a.roll_rad + h * rate.roll_rad};
  const Eigen::AngleAxisd turn(enu_from_body(a).conjugate() * enu_from_body(later));
  const Vec3 numeric = turn.axis() * wrap_pi(turn.angle()) / h;
  CHECK((numeric - body_rates_radps(a, rate)).norm() < 1e-5);
}
