#include "tests/physics/multibeam_speckle.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace ensonify;
using namespace ensonify::physics::multibeam_speckle;
using Catch::WithinAbs;

TEST_CASE("multibeam: pings decorrelate along the track as the transmit pattern says") {
  // Four seabeds, some 1,000 samples in all: a correlation has a standard deviation of 3 to 4 %.
  for (const double d_over_l : {0.02, 0.25, 0.55}) {
    const double reached = correlation_after({0.0, d_over_l * line_m(), 0.0}, 4);
    INFO(reached << " after " << d_over_l << " L, theory " << along_track(d_over_l));
    CHECK_THAT(reached, WithinAbs(along_track(d_over_l), 0.1));
  }
}

TEST_CASE("multibeam: a head at rest receives the same seabed again") {
  const auto once = amplitudes_of(receive(1, frames::Vec3::Zero(), true)),
             again = amplitudes_of(receive(1, frames::Vec3::Zero(), true));
  CHECK(once.size() > 150);
  CHECK((once == again));
}
