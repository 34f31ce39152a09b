#pragma once

#include <cmath>

namespace ensonify::random {

/// A number of Poisson's distribution from one uniform number in (0, 1), by inversion. For means up to about 100 (the
/// sum starts at e^-mean); at most 1000.
inline int poisson(double mean, double uniform) {
  int count = 0;
  double probability = std::exp(-mean), sum = probability;
  while (uniform > sum && count < 1000) {
    ++count;
    probability *= mean / count;
    sum += probability;
  }
  return count;
}

}  // namespace ensonify::random
