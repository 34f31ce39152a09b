#include "tools/patch/record_soundings.h"

#include <catch2/catch.hpp>

using namespace ensonify::patch_tool;
using ensonify::frames::Vec3;

TEST_CASE("what the estimate states of its errors is taken line by line") {
  // It settles on the first line, as a filter does: heading's variance falls from 4 and 2 to 1.
  std::vector<Stated> stated;
  for (const double variance : {4.0, 2.0, 1.0, 1.0, 1.0}) {
    stated.push_back({.time_s = 10.0 * static_cast<double>(stated.size()),
                      .position_variance_m2 = Vec3::Constant(0.5),
                      .rotation_variance_rad2 = Vec3(0, 0, variance)});
  }
  CHECK(mean_stated(stated, 0, 10).rotation_variance_rad2.z() == Approx(3));
  CHECK(mean_stated(stated, 15, 45).rotation_variance_rad2.z() == Approx(1));
  CHECK(mean_stated(stated, 0, 40).position_variance_m2.x() == Approx(0.5));
  CHECK(mean_stated(stated, 50, 60).rotation_variance_rad2 == Vec3::Zero());  // not given
}
