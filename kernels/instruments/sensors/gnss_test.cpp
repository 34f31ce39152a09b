#include "kernels/instruments/sensors/gnss.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace ensonify;
using namespace ensonify::sensors;
using Catch::WithinAbs;

namespace {

const GnssErrors kErrors{.fix = {0.01, 0.02, 0.03, 0.04}, .degraded = {0.3, 0.6, 0.1, 0.1}, .wander_s = 60.0};

}  // namespace

TEST_CASE("fixes are as far off as the receiver says") {
  Gnss gnss(kErrors, random::Stream(1, "gnss"));
  double east = 0, north = 0, up = 0, together = 0;
  constexpr int kCount = 20000;  // slow errors of 60 s at 10 s steps: about 3300 independent; 1.2 %, four times: 5 %
  frames::Vec3 last = frames::Vec3::Zero();
  for (int i = 0; i < kCount; ++i) {
    const GnssReading r = gnss.measure(2.0, false, 10.0);
    REQUIRE(r.quality == FixQuality::kRtkFixed);
    east += std::pow(r.error_enu_m.x() / r.sigma_enu_m.x(), 2);
    north += std::pow(r.error_enu_m.y() / r.sigma_enu_m.y(), 2);
    up += std::pow(r.error_enu_m.z() / r.sigma_enu_m.z(), 2);
    together += r.error_enu_m.x() * last.x();
    last = r.error_enu_m;
  }
  for (const double sum : {east, north, up}) CHECK_THAT(std::sqrt(sum / kCount), WithinAbs(1.0, 0.05));
  // Neighbours share the slow part only: 0.03^2 exp(-10 / 60).
  CHECK(together / kCount == Approx(9e-4 * std::exp(-1.0 / 6)).epsilon(0.1));
}

TEST_CASE("under water there is no fix; after it a poor one, then a good one") {
  Gnss gnss(kErrors, random::Stream(1, "gnss"));
  CHECK(gnss.measure(1.0, false, 1.0).quality == FixQuality::kRtkFixed);
  for (int i = 0; i < 10; ++i) CHECK(gnss.measure(-3.0, false, 1.0).quality == FixQuality::kNone);
  for (int i = 1; i <= 40; ++i) {
    const FixQuality expected = i < 5 ? FixQuality::kNone : i < 25 ? FixQuality::kRtkFloat : FixQuality::kRtkFixed;
    CHECK(gnss.measure(1.0, false, 1.0).quality == expected);
  }
  CHECK(gnss.measure(1.0, true, 1.0).quality == FixQuality::kNone);
}

TEST_CASE("poor geometry makes errors and their stated sigma larger alike") {
  GnssErrors poor = kErrors;
  poor.hdop = 3.0;
  const GnssReading good = Gnss(kErrors, random::Stream(4, "g")).measure(1, false, 0);
  const GnssReading bad = Gnss(poor, random::Stream(4, "g")).measure(1, false, 0);
  CHECK((bad.error_enu_m - 3.0 * good.error_enu_m).norm() < 1e-12);
  CHECK((bad.sigma_enu_m - 3.0 * good.sigma_enu_m).norm() < 1e-12);
}
