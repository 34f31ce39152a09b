#include "kernels/base/frames/pose.h"

#include <catch2/catch.hpp>
#include <numbers>

using namespace ensonify::frames;
constexpr double kDeg = std::numbers::pi / 180.0;

TEST_CASE("a head 2 m ahead of the reference of a body that points east is 2 m east of it") {
  const Pose body{{100, 50, -3}, enu_from_body(Attitude{90 * kDeg, 0, 0})};
  const HeadPose head = head_pose(body, Mounting{{2, 0, 1}, Quaternion::Identity()});
  CHECK((head.position_enu_m - Vec3(102, 50, -4)).norm() < 1e-12);
  CHECK((enu_from_head(head, {0, 0, 20}) - Vec3(102, 50, -24)).norm() < 1e-12);
}

TEST_CASE("to the head and back is where one started") {
  const Pose body{{1, 2, 3}, enu_from_body(Attitude{0.3, -0.2, 0.5})};
  const HeadPose head =
      head_pose(body, {{0.5, -0.1, 0.7}, Quaternion(Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()))});
  const Vec3 point(-7, 11, -20);
  CHECK((enu_from_head(head, head_from_enu(head, point)) - point).norm() < 1e-12);
}

TEST_CASE("half way between two headings across north is north") {
  const Pose a{{0, 0, 0}, enu_from_body(Attitude{350 * kDeg, 0, 0})};
  const Pose b{{10, 0, 0}, enu_from_body(Attitude{10 * kDeg, 0, 0})};
  const Pose middle = interpolate(a, b, 0.5);
  CHECK(middle.position_enu_m.x() == Approx(5.0));
  CHECK(middle.enu_from_body.angularDistance(enu_from_body(Attitude{})) < 1e-9);
  CHECK(interpolate(a, b, 0.25).enu_from_body.angularDistance(enu_from_body(Attitude{355 * kDeg, 0, 0})) < 1e-9);
}

TEST_CASE("a history interpolates inside its span; outside it gives the nearest on request") {
  PoseHistory poses(1'000'000'000);
  CHECK_FALSE(poses.at(0, PoseHistory::Outside::kNearest));
  for (int i = 0; i <= 30; ++i) CHECK(poses.push(i * 100'000'000LL, Pose{{double(i), 0, 0}}));
  CHECK_FALSE(poses.push(3'000'000'000, Pose{}));
  CHECK(poses.at(2'450'000'000)->position_enu_m.x() == Approx(24.5));
  CHECK(poses.at(3'000'000'000)->position_enu_m.x() == 30.0);
  CHECK_FALSE(poses.at(3'000'000'001));
  CHECK(poses.at(3'000'000'001, PoseHistory::Outside::kNearest)->position_enu_m.x() == 30.0);
  CHECK(poses.oldest_ns() == 2'000'000'000);  // one second kept
  CHECK_FALSE(poses.at(1'999'999'999));
}
