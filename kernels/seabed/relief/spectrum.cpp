#include "kernels/seabed/relief/spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "kernels/seabed/relief/window.h"
#include "kernels/seabed/statistics/power_spectrum.h"

namespace ensonify::relief {
namespace {

constexpr double kPi = std::numbers::pi;

[[noreturn]] void refuse(const std::string& what, double value, const std::string& allowed) {
  throw std::invalid_argument("relief spectrum: " + what + " is " + std::to_string(value) + ", allowed: " + allowed);
}

/// Integral of t^(order - 1) exp(-a t - b / t) dt over t > 0.
double gaussian_mixture(double order, double a, double b) {
  const double argument = 2.0 * std::sqrt(a * b);
  if (argument < 1e-6) return std::tgamma(order) * std::pow(a, -order);  // the limit, exact to 1e-6 for order > 0.5
  if (argument > 600.0) return 0.0;                                      // below e^-600
  return 2.0 * std::pow(b / a, 0.5 * order) * std::cyl_bessel_k(order, argument);
}

double outer_radpm(const Spectrum& spectrum) { return 2.0 * kPi / spectrum.outer_scale_m; }

/// 1 / (4 Ki^2)
double inner_m2(const Spectrum& spectrum) {
  const double length_m = spectrum.inner_scale_m / (4.0 * kPi);
  return length_m * length_m;
}

}  // namespace

void check(const Spectrum& spectrum) {
  if (!(spectrum.rms_m >= 0.0 && std::isfinite(spectrum.rms_m))) refuse("rms_m", spectrum.rms_m, "0 or more");
  if (!(spectrum.hurst > 0.0 && spectrum.hurst <= 1.0)) refuse("hurst", spectrum.hurst, "more than 0, at most 1");
  if (!(spectrum.outer_scale_m > 0.0 && spectrum.outer_scale_m <= 1e7))
    refuse("outer_scale_m", spectrum.outer_scale_m, "more than 0, at most 1e7");
  if (!(spectrum.inner_scale_m >= 0.0 && spectrum.inner_scale_m < spectrum.outer_scale_m))
    refuse("inner_scale_m", spectrum.inner_scale_m, "0 or more, below outer_scale_m");
}

double density_m4(const Spectrum& spectrum, double wave_number_radpm) {
  const double ko2 = outer_radpm(spectrum) * outer_radpm(spectrum), b = inner_m2(spectrum);
  const double h = spectrum.hurst;
  return spectrum.rms_m * spectrum.rms_m / kPi *
         gaussian_mixture(h + 1.0, ko2 + wave_number_radpm * wave_number_radpm, b) / gaussian_mixture(h, ko2, b);
}

double structure_m2(const Spectrum& spectrum, double distance_m) {
  // exp(-K^2 t) in wave number is exp(-r^2 / 4t) in distance: it joins the inner scale's term.
  const double ko2 = outer_radpm(spectrum) * outer_radpm(spectrum), b = inner_m2(spectrum);
  const double h = spectrum.hurst;
  const double correlation = gaussian_mixture(h, ko2, b + 0.25 * distance_m * distance_m) / gaussian_mixture(h, ko2, b);
  return 2.0 * spectrum.rms_m * spectrum.rms_m * (1.0 - correlation);
}

double facet_mean_square_slope(const Spectrum& spectrum, double post_spacing_m) {
  if (!(post_spacing_m > 0.0)) refuse("post_spacing_m", post_spacing_m, "more than 0");
  return 2.0 * structure_m2(spectrum, post_spacing_m) / (post_spacing_m * post_spacing_m);
}

double strength(const Spectrum& spectrum) {
  // rms^2 = 2 pi w2 Integral of K (K^2 + Ko^2)^-(H+1) dK = pi w2 Ko^-2H / H
  return spectrum.rms_m * spectrum.rms_m * spectrum.hurst * std::pow(outer_radpm(spectrum), 2.0 * spectrum.hurst) / kPi;
}

double rms_of_strength_m(double strength_si, double hurst, double outer_scale_m) {
  return std::sqrt(kPi * strength_si / hurst * std::pow(2.0 * kPi / outer_scale_m, -2.0 * hurst));
}

Octaves octaves_of(const Spectrum& spectrum, double post_spacing_m) {
  check(spectrum);
  if (!(post_spacing_m > 0.0)) refuse("post_spacing_m", post_spacing_m, "more than 0");
  constexpr double kNegligible = 1e-9;  // of the variance
  constexpr double kSplineWidth = 0.525;
  constexpr int kFinest = -80, kCoarsest = 40;
  const double ko2 = outer_radpm(spectrum) * outer_radpm(spectrum), b = inner_m2(spectrum);
  std::vector<double> weight;  // from kFinest
  double sum = 0.0;
  for (int level = kFinest; level <= kCoarsest; ++level) {
    const double h = node_spacing_m(post_spacing_m, level), t = kSplineWidth * h * h;
    weight.push_back(std::pow(t, spectrum.hurst) * std::exp(-t * ko2 - b / t));
    sum += weight.back();
  }
  Octaves octaves;
  double done = 0.0;
  for (int level = kFinest; level <= kCoarsest && done < (1.0 - kNegligible) * sum; ++level) {
    const double share = weight[static_cast<std::size_t>(level - kFinest)];
    const double variance_m2 = spectrum.rms_m * spectrum.rms_m * share / sum;
    done += share;
    if (level >= 0) {
      octaves.variance_m2.push_back(share > kNegligible * sum ? variance_m2 : 0.0);
      continue;
    }
    const double h = node_spacing_m(post_spacing_m, level), t = kSplineWidth * h * h;
    octaves.below_posts_m2 += variance_m2 * (1.0 - std::exp(-post_spacing_m * post_spacing_m / (4.0 * t)));
  }
  return octaves;
}

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
