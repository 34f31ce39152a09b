#include "kernels/vehicle/motion/lever.h"

#include <catch2/catch.hpp>

#include "kernels/base/frames/attitude.h"
#include "kernels/vehicle/motion/excursion.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

/// A body whose point at `lever` moves on parabolas while it rolls and turns.
frames::MovingPose of_point(double t) {
  const auto along = [&](double a, double b, double c) {
    return motion::Moving{a + b * t + c * t * t, b + 2 * c * t, 2 * c};
  };
  return motion::superimpose(frames::MovingPose{}, {along(1, 2, 0.3), along(-2, 1, 0.1), along(0, 0.2, -0.4),
                                                    along(0.1, 0.3, -0.2), along(0, -0.1, 0.3), along(1, 0.5, 0.1)});
}

}  // namespace

TEST_CASE("the reference point is at the point less the turned lever") {
  const frames::Vec3 lever(2.0, -1.0, -6.5);
  const frames::MovingPose point = of_point(0.7), reference = motion::reference_point(point, lever);
  const frames::Vec3 again = reference.pose.position_enu_m + reference.pose.enu_from_body * lever;
  CHECK((again - point.pose.position_enu_m).norm() < 1e-12);
}

TEST_CASE("its velocity and acceleration are the derivatives of its place") {
  const frames::Vec3 lever(2.0, -1.0, -6.5);
  const auto at = [&](double t) { return motion::reference_point(of_point(t), lever); };
  const double h = 1e-4;
  const frames::Vec3 before = at(0.7 - h).pose.position_enu_m, now = at(0.7).pose.position_enu_m,
                     after = at(0.7 + h).pose.position_enu_m;
  // Central differences err by h^2 / 6 of the third derivative, and by rounding: 1e-15 / h^2 = 1e-7.
  CHECK(((after - before) / (2 * h) - at(0.7).velocity_enu_mps).norm() < 1e-6);
  CHECK(((after - 2 * now + before) / (h * h) - at(0.7).acceleration_enu_mps2).norm() < 1e-5);
}
