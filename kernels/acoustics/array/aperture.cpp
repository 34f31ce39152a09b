#include "kernels/acoustics/array/aperture.h"

#include <cmath>
#include <numbers>

namespace ensonify::array {

std::complex<double> amplitude(const PlanarArray& array, double wavelength_m, const frames::Vec3& direction_head,
                               double sin_steer_x, double sin_steer_y) {
  return amplitude(array.along_x, wavelength_m, direction_head.x(), sin_steer_x) *
         amplitude(array.along_y, wavelength_m, direction_head.y(), sin_steer_y) *
         array.face.amplitude(direction_head.z());
}

double piston_amplitude(double diameter_in_waves, double sin_off_axis) {
  const double x = std::abs(std::numbers::pi * diameter_in_waves * sin_off_axis);
  return x < 1e-4 ? 1.0 - x * x / 8.0 : 2.0 * std::cyl_bessel_j(1.0, x) / x;
}

}  // namespace ensonify::array
