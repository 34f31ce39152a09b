#include <catch2/catch.hpp>
#include <cmath>

#include "components/runtime/testing/node_under_test.h"
#include "examples/gyro/node.h"
#include "kernels/base/frames/attitude.h"

using namespace ensonify;

static msg::Pose heading_east(SimTime t) {
  msg::Pose pose;
  pose.stamp_ns = t.count();
  pose.enu_from_body = frames::wxyz_of(frames::enu_from_body(frames::Attitude{1.5, 0.0, 0.2}));
  return pose;
}

TEST_CASE("the gyro reports heading plus its bias, ten times a second, whatever the roll") {
  GyroConfig config;
  config.bias_rad = 0.1;
  config.sigma_rad = 0.0;
  NodeUnderTest<GyroNode> gyro(config);
  gyro.give("pose", heading_east(0_s), heading_east(1_s));
  const auto headings = gyro.step_until<msg::Attitude>("heading", 1_s);
  REQUIRE(headings.size() == 11);
  CHECK(headings.back().heading_grid_rad == Approx(1.6));
}

TEST_CASE("the gyro's noise has the stated sigma") {
  GyroConfig config;
  config.bias_rad = 0.0;
  NodeUnderTest<GyroNode> gyro(config);
  gyro.give("pose", heading_east(0_s));
  double squares = 0.0;
  const auto headings = gyro.step_until<msg::Attitude>("heading", 500_s);
  for (const auto& h : headings) squares += std::pow(h.heading_grid_rad - 1.5, 2);
  // 5001 samples: the estimate of sigma strays by 1 %; four times that is allowed.
  CHECK(std::sqrt(squares / static_cast<double>(headings.size())) == Approx(config.sigma_rad).epsilon(0.04));
}

TEST_CASE("without a pose there is nothing to measure") {
  NodeUnderTest<GyroNode> gyro(GyroConfig{});
  CHECK(gyro.step_until<msg::Attitude>("heading", 1_s).empty());
}
