#pragma once

#include <complex>
#include <span>
#include <vector>

#include "kernels/acoustics/detect/bottom.h"
#include "kernels/base/random/stream.h"

/// Test support: the echo of a plane of dense random scatterers, as a sum over the scatterers.
namespace ensonify::detect {

struct PlaneSurvey {
  double depth_m = 20.0;           // along the normal of the plane
  double tilt_rad = 0.0;           // of that normal from the array's
  double length_in_waves = 50.76;  // 1 degree
  double pulse_length_s = 100e-6;
  double period_s = 25e-6;
  double sound_speed_mps = 1500.0;
  double snr_db = 20.0;    // mean echo power at the beam's axis over noise; infinity: no noise
  double longest_s = 0.1;  // of the record
  double scatterers_per_pulse = 12.0;
  double second_db = -300.0;  // energy of a second echo, that of a plane twice as deep, over the first's
  std::vector<float> sin_beams;
};

/// A ping as a receiver with two halves receives it. Scatterers lie evenly in sine within kReach of each beam's axis,
/// each beam's its own; their mean power falls as 1 / R^2 (a level Lambert seabed, per sine). Scaled so that the mean
/// energy of a beam's echo is the pulse length: 1 uPa^2 were it to come at once.
struct PlaneEcho {
  static constexpr double kReach = 3.0;  // lambda / L
  std::vector<float> amplitude_upa;
  std::vector<std::complex<float>> positive_upa, negative_upa;

  void ping(const PlaneSurvey& survey, const random::Stream& stream, std::uint64_t number);
  Amplitudes amplitudes(const PlaneSurvey& survey) const;
  HalfApertures halves() const { return {positive_upa, negative_upa}; }
};

/// Settings of this survey's detector.
Settings settings_for(const PlaneSurvey& survey);

/// Two-way time of the plane at the axis of a beam.
double two_way_s(const PlaneSurvey& survey, double sin_beam);

}  // namespace ensonify::detect
