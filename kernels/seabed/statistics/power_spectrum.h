#pragma once

#include <vector>

#include "kernels/seabed/statistics/surface.h"

namespace ensonify::relief_statistics {

/// Spectral density of a surface by wave number, over all directions.
struct RadialSpectrum {
  std::vector<double> wave_number_radpm;  // of the bins, rising: mean of ln K over the bin, as K
  std::vector<double> density_m4;         // mean of W in the bin; W's integral over the plane is the variance
  std::vector<int> numbers;               // how many numbers of a transform fell into the bin
};

/// By the mean periodogram of all windows of `window_cells` x `window_cells` posts without a hole, half overlapping,
/// each less its plane and tapered by Hann's window [Harris1978]; bins of a quarter octave from two waves per window
/// to Nyquist's. Empty if no window is whole. Throws std::invalid_argument for windows of odd size or below 16 posts.
RadialSpectrum radial_spectrum(const Surface& surface, int window_cells);

/// Mean of 10 log10(a / b) over the bins of a band of wave numbers, dB. Throws std::invalid_argument for spectra of
/// different bins, or a band without any.
double difference_db(const RadialSpectrum& a, const RadialSpectrum& b, double low_radpm, double high_radpm);

/// W = strength K^-exponent
struct PowerLaw {
  double exponent = 0.0;
  double strength = 0.0;
};

/// Least squares of ln W over ln K for the bins from `low` to `high`, rad/m, each bin weighing the same. Throws
/// std::invalid_argument if fewer than three bins lie there.
PowerLaw fit_power_law(const RadialSpectrum& spectrum, double low_radpm, double high_radpm);

/// Exponents of S_q(r) ~ r^zeta(q), q = 1, 2, 3: least squares of ln S over ln r at lags 1, 2, 4 ... 32 cells.
struct ScalingExponents {
  double zeta_1 = 0.0;
  double zeta_2 = 0.0;
  double zeta_3 = 0.0;

  /// 0 for one Gaussian law everywhere (zeta(q) = q H); the intermittency of a lognormal cascade.
  double k2() const { return 2.0 * zeta_1 - zeta_2; }
};

/// Throws std::invalid_argument unless the surface is more than 32 posts wide and high, and not level.
ScalingExponents scaling_exponents(const Surface& surface);

}  // namespace ensonify::relief_statistics
