#pragma once

#include <vector>

#include "kernels/survey/boresight/adjust.h"

namespace ensonify::boresight {

/// Variances of the unknowns, and by how many degrees of freedom each is known [Satterthwaite1946].
struct Spread {
  Unknowns variance = Unknowns::Zero(), freedom = Unknowns::Zero();
};

/// Mean of several layings of the squares over the same soundings, each with its spread. Its
/// variance is that within a laying, in the mean, and (1 + 1/m) times that between them [Rubin1987, ch. 3]. That is too
/// much rather than too little: a mean of m errs less than one laying, as far as layings differ.
struct Found {
  Unknowns unknowns = Unknowns::Zero();
  Spread spread;
};
Found mean_of(const std::vector<Found>& layings);

/// Half widths of the 95 % intervals: Student's t, by Cornish and Fisher's series in 1 / freedom (to 1 % from 3 on,
/// below that as for 3) [Abramowitz1964].
Unknowns half_95(const Spread& spread);

}  // namespace ensonify::boresight
