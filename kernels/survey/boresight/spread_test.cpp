#include <catch2/catch.hpp>

#include "kernels/survey/boresight/adjust.h"

using namespace ensonify::boresight;

namespace {

Found laying(double value, double variance, double freedom) {
  return {Unknowns::Constant(value), {Unknowns::Constant(variance), Unknowns::Constant(freedom)}};
}

}  // namespace

TEST_CASE("layings that agree are known as one of them is") {
  const Found mean = mean_of({laying(3, 4, 20), laying(3, 4, 20), laying(3, 4, 20)});
  CHECK(mean.unknowns[0] == Approx(3));
  CHECK(mean.spread.variance[0] == Approx(4));
  CHECK(mean.spread.freedom[0] == Approx(20));
}

TEST_CASE("what layings differ by widens the interval by Rubin's rule") {
  // Between 1 and 3, variance 2; times 1 + 1/2 makes 3. Degrees of freedom [Rubin1987, eq. 3.1.6]: (m - 1)(1 + W/3)^2.
  const Found mean = mean_of({laying(1, 4, 1e12), laying(3, 4, 1e12)});
  CHECK(mean.unknowns[0] == Approx(2));
  CHECK(mean.spread.variance[0] == Approx(7));
  CHECK(mean.spread.freedom[0] == Approx((1 + 4.0 / 3) * (1 + 4.0 / 3)));
}

TEST_CASE("intervals of few degrees of freedom are wider") {  // tables of Student's t: 3.182, 2.228, 1.960
  CHECK(half_95({Unknowns::Constant(4), Unknowns::Constant(3)})[0] == Approx(2 * 3.182).epsilon(0.01));
  CHECK(half_95({Unknowns::Constant(4), Unknowns::Constant(10)})[0] == Approx(2 * 2.228).epsilon(0.001));
  CHECK(half_95({Unknowns::Constant(4), Unknowns::Constant(1e9)})[0] == Approx(2 * 1.960).epsilon(0.001));
}
