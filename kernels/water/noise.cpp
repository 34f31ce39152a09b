#include "kernels/water/noise.h"

#include <cmath>

namespace ensonify::water {

double thermal_noise_level_db(double frequency_hz) { return -15.0 + 20.0 * std::log10(frequency_hz * 1e-3); }

double in_band_level_db(double spectral_level_db, double bandwidth_hz, double directivity_index_db) {
  return spectral_level_db + 10.0 * std::log10(bandwidth_hz) - directivity_index_db;
}

}  // namespace ensonify::water
