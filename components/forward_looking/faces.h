#pragma once

#include <Eigen/Core>

#include "components/forward_looking/config.h"
#include "kernels/acoustics/array/aperture.h"
#include "kernels/acoustics/array/pattern_table.h"

namespace ensonify {

/// Directivity of the faces of a forward-looking head (unit vectors, head frame): what is not the receive
/// array's beams.
///
/// In elevation both faces are uniform lines across the tilted axis. In azimuth the transmission falls as a power of
/// the cosine, to -3 dB at the edges of the aperture, and each receive element is as long as its spacing. Behind the
/// face both are 40 dB lower. With directivity switched off all are 1 in front and behind.
class ForwardFaces {
 public:
  /// element_in_waves: length of a receive element.
  ForwardFaces(const ForwardLookingConfig& config, double element_in_waves);

  /// Power of the transmission, 1 on its axis.
  double transmitted_power(const Eigen::Vector3f& direction_head) const;
  /// Amplitude of a receive element, with sign, 1 on its axis.
  float element_amplitude(const Eigen::Vector3f& direction_head) const;
  /// Isotropic noise that an element lets in, over what a point would: its pattern's mean around the receive line.
  double noise_share() const;

 private:
  bool directivity_;
  Eigen::Vector3f axis_head_, up_the_face_head_;
  array::Face face_;
  float cosine_power_;  // of the transmission in azimuth
  array::PatternTable transmit_vertical_, receive_vertical_, element_;
};

}  // namespace ensonify
