#pragma once

#include <complex>

#include "kernels/array/line_array.h"
#include "kernels/frames/attitude.h"

/// Patterns of plane apertures: rectangles as products of two lines, circular pistons, and what the face adds.
namespace ensonify::array {

/// How the face of a head weighs directions, besides the interference of its elements.
struct Face {
  double cosine_power = 0.0;  // amplitude falls as cos^q of the angle from the normal; 0: not at all, 1: soft baffle
  double back_loss_db = 0.0;  // less amplitude behind the face (a baffle), positive; 0: as much as in front
};

/// Amplitude in a direction whose cosine from the outward normal is `cos_normal`; negative is behind the face.
double face_amplitude(const Face& face, double cos_normal);

/// Elements in rows and columns whose weights are products, in the plane of the head's x and y axes.
struct PlanarArray {
  LineArray along_x;
  LineArray along_y;
  Face face;
};

/// Amplitude in a direction (unit vector, head frame FRD; z is the outward normal): the product of both lines' patterns
/// in the direction cosines x and y, and of the face.
std::complex<double> amplitude(const PlanarArray& array, double wavelength_m, const frames::Vec3& direction_head,
                               double sin_steer_x = 0.0, double sin_steer_y = 0.0);

/// Amplitude, with sign, of a circular piston D / lambda wide at the sine of the angle from its axis:
/// 2 J1(x) / x, x = pi D / lambda sin. Half-power width 58.96 lambda / D degrees, first side lobe -17.57 dB
/// [Lurton2010, ch. 5].
double piston_amplitude(double diameter_in_waves, double sin_off_axis);

}  // namespace ensonify::array
