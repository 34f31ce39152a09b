#include "kernels/survey/boresight/spread.h"

#include <algorithm>
#include <cmath>

namespace ensonify::boresight {

namespace {

double student_95(double freedom) {
  constexpr double z = 1.959964, z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
  const double f = std::max(freedom, 3.0);
  return z + (z3 + z) / (4 * f) + (5 * z5 + 16 * z3 + 3 * z) / (96 * f * f) +
         (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * f * f * f);
}

}  // namespace

Found mean_of(const std::vector<Found>& layings) {
  const auto m = static_cast<double>(layings.size());
  if (layings.size() == 1) return layings[0];
  Found mean;
  Unknowns within = Unknowns::Zero(), unsure = Unknowns::Zero(), between = Unknowns::Zero();
  for (const Found& laying : layings) {
    mean.unknowns += laying.unknowns / m;
    within += laying.spread.variance / m;
    unsure += laying.spread.variance.cwiseAbs2().cwiseQuotient(laying.spread.freedom) / m;
  }
  for (const Found& laying : layings) between += (laying.unknowns - mean.unknowns).cwiseAbs2() / (m - 1.0);
  between *= 1.0 + 1.0 / m;
  unsure += between.cwiseAbs2() / (m - 1.0);
  mean.spread.variance = within + between;
  mean.spread.freedom = mean.spread.variance.cwiseAbs2().cwiseQuotient(unsure);
  return mean;
}

Unknowns half_95(const Spread& spread) {
  return spread.variance.cwiseSqrt().cwiseProduct(spread.freedom.unaryExpr(&student_95));
}

}  // namespace ensonify::boresight
