#include "kernels/seabed/relief/restoration.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "kernels/seabed/statistics/power_spectrum.h"

namespace ensonify::relief {

Detail detail_below(const relief_statistics::Surface& guide, double hurst, double band_start_cells) {
  if (!(band_start_cells >= 2.0 && band_start_cells <= 16.0)) {
    throw std::invalid_argument("detail: band_start_cells is " + std::to_string(band_start_cells) +
                                ", allowed: 2 to 16");
  }
  relief_statistics::RadialSpectrum spectrum;
  for (int window = 128; window >= 16 && spectrum.density_m4.empty(); window /= 2)
    spectrum = relief_statistics::radial_spectrum(guide, window);
  const double last_trusted_radpm = 2.0 * std::numbers::pi / (band_start_cells * guide.spacing_m);
  Detail detail;
  detail.spectrum = {.rms_m = 0.0, .hurst = hurst, .outer_scale_m = 2.0 * band_start_cells * guide.spacing_m};
  const double gamma = 2.0 * hurst + 2.0;
  double sum = 0.0;
  int bins = 0;
  for (std::size_t i = 0; i < spectrum.density_m4.size(); ++i) {
    const double k = spectrum.wave_number_radpm[i];
    if (k < 0.5 * last_trusted_radpm || k > 0.9 * last_trusted_radpm) continue;
    if (!(spectrum.density_m4[i] > 0.0)) continue;
    sum += std::log(spectrum.density_m4[i]) + gamma * std::log(k);
    ++bins;
  }
  if (bins == 0) return detail;
  detail.strength_si = std::exp(sum / bins);
  detail.spectrum.rms_m = rms_of_strength_m(detail.strength_si, hurst, detail.spectrum.outer_scale_m);
  return detail;
}

}  // namespace ensonify::relief
