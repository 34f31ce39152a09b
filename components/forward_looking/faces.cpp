#include "components/forward_looking/faces.h"

#include <cmath>
#include <numbers>

#include "kernels/acoustics/array/line.h"

namespace ensonify {
namespace {

constexpr double kBackLoss_db = 40.0;

array::PatternTable line_pattern(double length_in_waves) {
  return {[=](double sine) { return array::line_amplitude(length_in_waves, sine); }, 0.5 * length_in_waves};
}

/// cos^q is -3 dB at half the aperture.
float cosine_power(double aperture_rad) {
  return static_cast<float>(std::log(std::sqrt(0.5)) / std::log(std::cos(0.5 * aperture_rad)));
}

Eigen::Vector3f in_vertical_plane(double down_rad) {
  return {static_cast<float>(std::cos(down_rad)), 0.0F, static_cast<float>(std::sin(down_rad))};
}

}  // namespace

ForwardFaces::ForwardFaces(const ForwardLookingConfig& config, double element_in_waves)
    : directivity_(config.effects.directivity),
      axis_head_(in_vertical_plane(config.tilt_rad)),
      up_the_face_head_(in_vertical_plane(config.tilt_rad - 0.5 * std::numbers::pi)),
      face_(0.0, kBackLoss_db),
      cosine_power_(cosine_power(config.aperture_rad)),
      transmit_vertical_(line_pattern(array::length_in_waves_for(config.transmit_vertical_rad))),
      receive_vertical_(line_pattern(array::length_in_waves_for(config.receive_vertical_rad))),
      element_(line_pattern(element_in_waves)) {}

double ForwardFaces::transmitted_power(const Eigen::Vector3f& direction) const {
  if (!directivity_) return 1.0;
  const float u = direction.y(), across = std::pow(std::max(0.0F, (1.0F - u) * (1.0F + u)), cosine_power_);
  const double face = face_.amplitude(static_cast<double>(axis_head_.dot(direction)));
  return static_cast<double>(across) * face * face *
         static_cast<double>(transmit_vertical_.power(static_cast<double>(up_the_face_head_.dot(direction))));
}

float ForwardFaces::element_amplitude(const Eigen::Vector3f& direction) const {
  if (!directivity_) return 1.0F;
  return element_.amplitude(static_cast<double>(direction.y())).real() *
         receive_vertical_.amplitude(static_cast<double>(up_the_face_head_.dot(direction))).real() *
         static_cast<float>(face_.amplitude(static_cast<double>(axis_head_.dot(direction))));
}

double ForwardFaces::noise_share() const {
  constexpr int kSteps = 3600;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double amplitude =
        static_cast<double>(element_amplitude(in_vertical_plane(2.0 * std::numbers::pi * i / kSteps)));
    sum += amplitude * amplitude / kSteps;
  }
  return sum;
}

}  // namespace ensonify
