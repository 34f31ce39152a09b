#pragma once

#include <cmath>
#include <complex>

#include "kernels/acoustics/array/line.h"
#include "kernels/base/frames/attitude.h"

/// Patterns of plane apertures: rectangles as products of two lines, circular pistons, and what the face adds.
namespace ensonify::array {

/// Directivity of a head's face, besides the interference of its elements.
class Face {
 public:
  /// All directions alike.
  Face() = default;
  /// cosine_power: amplitude falls as cos^q of the angle from the normal; 0: not at all, 1: soft baffle.
  /// back_loss_db: less amplitude behind the face (a baffle), positive; 0: as much as in front.
  Face(double cosine_power, double back_loss_db)
      : cosine_power_(cosine_power), behind_(std::pow(10.0, -back_loss_db / 20.0)) {}

  /// Whether the amplitude depends on the side alone, and what it is behind.
  bool even() const { return cosine_power_ == 0.0; }
  double behind() const { return behind_; }

  /// Amplitude in a direction whose cosine from the outward normal is `cos_normal`; negative is behind the face.
  double amplitude(double cos_normal) const {
    const double front = cosine_power_ == 0.0 ? 1.0 : std::pow(std::abs(cos_normal), cosine_power_);
    return cos_normal >= 0.0 ? front : front * behind_;
  }

 private:
  double cosine_power_ = 0.0;
  double behind_ = 1.0;
};

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
