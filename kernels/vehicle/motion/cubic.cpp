#include "kernels/vehicle/motion/cubic.h"

namespace ensonify::motion {

Moving cubic_between(const Moving& from, const Moving& to, double length, double u) {
  const double h = length, chord = (to.value - from.value) / h;
  const double square = (3.0 * chord - 2.0 * from.rate - to.rate) / h;
  const double cube = (from.rate + to.rate - 2.0 * chord) / (h * h);
  return {from.value + u * (from.rate + u * (square + u * cube)), from.rate + u * (2.0 * square + 3.0 * u * cube),
          2.0 * square + 6.0 * u * cube};
}

}  // namespace ensonify::motion
