#include "kernels/water/noise.h"

#include <cmath>

namespace ensonify::water {
namespace {

/// Level of two independent noises together; either may be -inf.
double together_db(double a_db, double b_db) {
  return 10.0 * std::log10(std::pow(10.0, a_db / 10.0) + std::pow(10.0, b_db / 10.0));
}

}  // namespace

double thermal_noise_level_db(double frequency_hz) { return -15.0 + 20.0 * std::log10(frequency_hz * 1e-3); }

double wind_noise_level_db(double frequency_hz, double wind_speed_mps) {
  constexpr double kMpsPerKnot = 1852.0 / 3600.0;
  return 51.0 + 5.0 * std::log2(wind_speed_mps / (5.0 * kMpsPerKnot)) - 5.0 * std::log2(frequency_hz * 1e-3);
}

double ambient_noise_level_db(double frequency_hz, double wind_speed_mps) {
  return together_db(thermal_noise_level_db(frequency_hz), wind_noise_level_db(frequency_hz, wind_speed_mps));
}

double in_band_level_db(double spectral_level_db, double bandwidth_hz, double directivity_index_db) {
  return spectral_level_db + 10.0 * std::log10(bandwidth_hz) - directivity_index_db;
}

double received_noise_level_db(double frequency_hz, double wind_speed_mps, const Receiver& receiver) {
  const double ambient_db = ambient_noise_level_db(frequency_hz, wind_speed_mps) - receiver.directivity_index_db;
  return in_band_level_db(together_db(ambient_db, receiver.electronic_noise_db), receiver.bandwidth_hz, 0.0);
}

}  // namespace ensonify::water
