#include "kernels/seabed/statistics/power_spectrum.h"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>

#include "kernels/base/fft/transform.h"
#include "kernels/seabed/statistics/surface.h"

namespace ensonify::relief_statistics {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kBinsPerOctave = 4;

int wave_of(int line, int size) { return line <= size / 2 ? line : line - size; }

/// Mean of |F|^2 over the windows, for each pair of lines; empty without a window.
std::vector<double> mean_periodogram(const Surface& surface, int size, const std::vector<double>& taper) {
  const auto n = static_cast<std::size_t>(size);
  std::vector<double> power;
  std::vector<std::complex<float>> numbers(n * n);
  Patch patch;
  int windows = 0;
  for (int row = 0; row + size <= surface.rows; row += size / 2) {
    for (int column = 0; column + size <= surface.columns; column += size / 2) {
      if (!patch_of(surface, column, row, size, patch)) continue;
      for (std::size_t i = 0; i < n * n; ++i)
        numbers[i] = static_cast<float>(patch.residual_m[i] * taper[i % n] * taper[i / n]);
      fft::transform_plane(numbers, size, size, fft::Transform::Sign::kMinus);
      power.resize(n * n, 0.0);
      for (std::size_t i = 0; i < n * n; ++i) power[i] += std::norm(std::complex<double>(numbers[i]));
      ++windows;
    }
  }
  for (double& p : power) p /= windows;
  return power;
}

/// Means of differences, their squares and their cubes.
struct Powers {
  double first = 0.0, second = 0.0, third = 0.0;
};

/// Over all pairs of posts `lag` apart along a row or a column; holes are left out. NaN if there is no pair.
Powers mean_over_pairs(const Surface& surface, int lag) {
  Powers sum;
  double pairs = 0.0;
  const auto add = [&](float a, float b) {
    const double d = std::abs(static_cast<double>(a) - static_cast<double>(b));
    if (std::isnan(d)) return;
    sum.first += d, sum.second += d * d, sum.third += d * d * d;
    pairs += 1.0;
  };
  for (int j = 0; j < surface.rows; ++j) {
    for (int i = 0; i + lag < surface.columns; ++i) add(surface.at(i, j), surface.at(i + lag, j));
    if (j + lag >= surface.rows) continue;
    for (int i = 0; i < surface.columns; ++i) add(surface.at(i, j), surface.at(i, j + lag));
  }
  const double by = 1.0 / pairs;
  return {sum.first * by, sum.second * by, sum.third * by};
}

}  // namespace

RadialSpectrum radial_spectrum(const Surface& surface, int window_cells) {
  check(surface);
  if (window_cells < 16 || window_cells % 2 != 0)
    throw std::invalid_argument("window_cells is " + std::to_string(window_cells) + ", allowed: even, 16 or more");
  const int n = window_cells;
  std::vector<double> taper;
  double taper_power = 0.0;
  for (int i = 0; i < n; ++i) {
    taper.push_back(0.5 - 0.5 * std::cos(2.0 * kPi * (i + 0.5) / n));
    taper_power += taper.back() * taper.back();
  }
  const std::vector<double> power = mean_periodogram(surface, n, taper);
  if (power.empty()) return {};
  const double scale = surface.spacing_m * surface.spacing_m / (4.0 * kPi * kPi * taper_power * taper_power);
  const auto bins = static_cast<std::size_t>(kBinsPerOctave * std::log2(0.25 * n));  // K from 2 waves to n / 2
  std::vector<double> sum(bins, 0.0), log_k(bins, 0.0);
  std::vector<int> numbers(bins, 0);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const double waves = std::hypot(wave_of(i, n), wave_of(j, n));
      if (waves < 2.0) continue;
      const auto bin = static_cast<std::size_t>(kBinsPerOctave * std::log2(0.5 * waves));
      if (bin >= bins) continue;
      sum[bin] += power[static_cast<std::size_t>(j) * static_cast<std::size_t>(n) + static_cast<std::size_t>(i)];
      log_k[bin] += std::log(2.0 * kPi * waves / (n * surface.spacing_m));
      ++numbers[bin];
    }
  }
  RadialSpectrum spectrum;
  for (std::size_t bin = 0; bin < bins; ++bin) {
    if (numbers[bin] == 0) continue;
    spectrum.wave_number_radpm.push_back(std::exp(log_k[bin] / numbers[bin]));
    spectrum.density_m4.push_back(scale * sum[bin] / numbers[bin]);
    spectrum.numbers.push_back(numbers[bin]);
  }
  return spectrum;
}

PowerLaw fit_power_law(const RadialSpectrum& spectrum, double low_radpm, double high_radpm) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < spectrum.wave_number_radpm.size(); ++i) {
    const double k = spectrum.wave_number_radpm[i];
    if (k < low_radpm || k > high_radpm || !(spectrum.density_m4[i] > 0.0)) continue;
    x.push_back(std::log(k));
    y.push_back(std::log(spectrum.density_m4[i]));
  }
  if (x.size() < 3)
    throw std::invalid_argument("a power law needs three bins; " + std::to_string(x.size()) + " lie in the band");
  const Line line = fit_line(x, y);
  return {-line.slope, std::exp(line.at_zero)};
}

double difference_db(const RadialSpectrum& a, const RadialSpectrum& b, double low_radpm, double high_radpm) {
  if (a.wave_number_radpm != b.wave_number_radpm) throw std::invalid_argument("spectra to compare have other bins");
  double sum = 0.0;
  int bins = 0;
  for (std::size_t i = 0; i < a.density_m4.size(); ++i) {
    if (a.wave_number_radpm[i] < low_radpm || a.wave_number_radpm[i] > high_radpm) continue;
    sum += 10.0 * std::log10(a.density_m4[i] / b.density_m4[i]);
    ++bins;
  }
  if (bins == 0) throw std::invalid_argument("no bin of the spectra lies in the band");
  return sum / bins;
}

ScalingExponents scaling_exponents(const Surface& surface) {
  check(surface);
  constexpr std::array<int, 6> kLags{1, 2, 4, 8, 16, 32};
  if (surface.columns <= kLags.back() || surface.rows <= kLags.back()) {
    throw std::invalid_argument("scaling exponents: the surface has " + std::to_string(surface.columns) + " x " +
                                std::to_string(surface.rows) + " posts, allowed: more than 32 each way");
  }
  std::array<double, kLags.size()> x, first, second, third;
  for (std::size_t i = 0; i < kLags.size(); ++i) {
    const Powers mean = mean_over_pairs(surface, kLags[i]);
    if (!(mean.first > 0.0)) throw std::invalid_argument("scaling exponents: the surface is level, or all holes");
    x[i] = std::log(kLags[i]);
    first[i] = std::log(mean.first);
    second[i] = std::log(mean.second);
    third[i] = std::log(mean.third);
  }
  return {fit_line(x, first).slope, fit_line(x, second).slope, fit_line(x, third).slope};
}

}  // namespace ensonify::relief_statistics
