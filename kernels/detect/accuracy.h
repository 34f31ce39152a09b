#pragma once

#include "kernels/detect/plane_echo.h"

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

/// One entry per beam of the survey. settings are those of the detector.
std::vector<Accuracy> accuracy(const PlaneSurvey& survey, const Settings& settings, int pings);

}  // namespace ensonify::detect
