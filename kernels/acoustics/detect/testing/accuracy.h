#pragma once

#include "kernels/acoustics/detect/testing/plane_echo.h"

/// Test support: how well a plane is detected.
namespace ensonify::detect {

struct Accuracy {
  double angle_rad = 0.0;
  double found = 0.0;         // share of pings
  double bias = 0.0;          // of the range at the beam's axis, relative (so of the depth too)
  double sd = 0.0;            // likewise, about the mean
  double predicted_sd = 0.0;  // root mean square of what the detector says of itself
  double amplitude_sd = 0.0;  // likewise, of amplitude alone
  double phase_weight = 0.0;  // mean
};

/// Relative standard deviation that theory allows a zero crossing [Lurton2010b]: sigma_phi^2 = 1 / SNR over N
/// independent pulses, and the floor of 0.05 % that speckle leaves; up to 10 degrees the centre of gravity, whose 9 mm
/// at nadir and 13 mm at 10 degrees stand for 100 us in 20 m (simulated by others: 6-12 and 9-17 mm for 50-200 us).
/// For beams of 1 degree, 100 us, 20 m.
double theoretical_sd(double angle_rad, double snr_db);

/// One entry per beam of the survey. settings are those of the detector.
std::vector<Accuracy> accuracy(const PlaneSurvey& survey, const Settings& settings, int pings);

/// 20 m, 1 degree, 100 us. The gate is an operator's: a quarter of the depth either way, so that 11 dB suffice at 10
/// dB.
std::vector<Accuracy> accuracy_at(double snr_db, const std::vector<double>& angles_deg, double tilt_rad, int pings);

}  // namespace ensonify::detect
