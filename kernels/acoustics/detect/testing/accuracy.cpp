#include "kernels/acoustics/detect/testing/accuracy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ensonify::detect {

double theoretical_sd(double angle_rad, double snr_db) {
  constexpr double kDeg = std::numbers::pi / 180.0;
  const double beta = std::abs(angle_rad), range_m = 20.0 / std::cos(beta);
  if (beta < 10.5 * kDeg) return (9e-3 + 4e-3 * beta / (10 * kDeg)) / 20.0;
  const double pulses = std::max(1.0, range_m * std::tan(beta) * 1.0 * kDeg / std::cos(beta) / (1500 * 100e-6 / 2));
  const double by_noise = std::pow(10, -0.05 * snr_db) * std::sin(beta) /
                          (2 * std::numbers::pi * 0.5 * 50.76 * std::pow(std::cos(beta), 2) * std::sqrt(pulses));
  return std::hypot(by_noise, 5e-4);
}

std::vector<Accuracy> accuracy(const PlaneSurvey& survey, const Settings& settings, int pings) {
  const std::size_t beams = survey.sin_beams.size();
  std::vector<Accuracy> sums(beams);
  PlaneEcho echo;
  std::vector<Detection> with_phase, alone;
  for (int ping = 0; ping < pings; ++ping) {
    echo.ping(survey, {11, "plane"}, static_cast<std::uint64_t>(ping));
    detect_bottom(settings, survey.sin_beams, echo.amplitudes(survey), echo.halves(), with_phase);
    detect_bottom(settings, survey.sin_beams, echo.amplitudes(survey), alone);
    for (std::size_t beam = 0; beam < beams; ++beam) {
      const Detection& d = with_phase[beam];
      if (!d.valid) continue;
      const double truth = two_way_s(survey, survey.sin_beams[beam]);
      const double error = d.two_way_s / truth - 1.0;
      const double amplitude_error = alone[beam].two_way_s / truth - 1.0;
      Accuracy& sum = sums[beam];
      sum.found += 1.0;
      sum.bias += error;
      sum.sd += error * error;
      sum.predicted_sd += std::pow(10.0, -2.0 * d.quality);
      sum.amplitude_sd += amplitude_error * amplitude_error;
      sum.phase_weight += d.phase_weight;
    }
  }
  for (std::size_t beam = 0; beam < beams; ++beam) {
    Accuracy& sum = sums[beam];
    const double n = std::max(sum.found, 1.0);
    sum.angle_rad = std::asin(survey.sin_beams[beam]);
    sum.found /= pings;
    sum.bias /= n;
    sum.sd = std::sqrt(std::max(sum.sd / n - sum.bias * sum.bias, 0.0));
    sum.predicted_sd = std::sqrt(sum.predicted_sd / n);
    sum.amplitude_sd = std::sqrt(sum.amplitude_sd / n);
    sum.phase_weight /= n;
  }
  return sums;
}

std::vector<Accuracy> accuracy_at(double snr_db, const std::vector<double>& angles_deg, double tilt_rad, int pings) {
  PlaneSurvey survey;
  survey.snr_db = snr_db;
  survey.tilt_rad = tilt_rad;
  for (const double deg : angles_deg) {
    survey.sin_beams.push_back(static_cast<float>(std::sin(deg * std::numbers::pi / 180.0)));
  }
  Settings settings = settings_for(survey);
  settings.seabed_tilt_rad = tilt_rad;
  settings.gates = {.min_depth_m = 15.0, .max_depth_m = 25.0, .snr_db = snr_db < 15.0 ? 11.0 : 13.0};
  return accuracy(survey, settings, pings);
}

}  // namespace ensonify::detect
