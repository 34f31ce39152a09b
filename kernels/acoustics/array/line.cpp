#include "kernels/acoustics/array/line.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace ensonify::array {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kHalfPower = 0.442946470689;  // sinc^2 is one half here

/// First sine beyond `from`, in the direction of `step`, at which the pattern is `level`; -1 or 1 where it is not.
double crossing(const std::function<double(double)>& pattern, double from, double step, double level) {
  double inside = from, outside = from + step;
  while (pattern(outside) > level) {
    if (std::abs(outside) >= 1.0) return std::copysign(1.0, step);
    inside = outside;
    outside += step;
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + outside);
    (pattern(middle) > level ? inside : outside) = middle;
  }
  return std::clamp(inside, -1.0, 1.0);
}

/// Simpson's rule over -1..1 of a function that has at most `cycles` periods per unit.
template <typename Function>
double integral_over_sine(const Function& f, double cycles) {
  const int pairs = 16 + static_cast<int>(std::ceil(32.0 * cycles));
  const double h = 1.0 / pairs;  // 2 pairs intervals over a length of 2
  double sum = f(-1.0) + f(1.0);
  for (int i = 1; i < 2 * pairs; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * f(-1.0 + h * i);
  return sum * h / 3.0;
}

/// The largest number of periods that the power pattern can have per unit of sine.
double cycles(const LineArray& array, double wavelength_m) {
  return (array.length_m() + array.element_length_m) / wavelength_m;
}

double centre_of_gravity_elements(const std::vector<double>& weights) {
  double sum = 0.0, moment = 0.0;
  for (std::size_t n = 0; n < weights.size(); ++n) {
    sum += weights[n];
    moment += weights[n] * static_cast<double>(n);
  }
  return moment / sum;
}

}  // namespace

double sinc(double x) {
  const double a = kPi * x;
  return std::abs(a) < 1e-4 ? 1.0 - a * a / 6.0 : std::sin(a) / a;
}

double line_amplitude(double length_in_waves, double sin_angle, double sin_steer) {
  return sinc(length_in_waves * (sin_angle - sin_steer));
}

double line_power(double length_in_waves, double sin_angle, double sin_steer) {
  const double amplitude = line_amplitude(length_in_waves, sin_angle, sin_steer);
  return amplitude * amplitude;
}

double equivalent_width(double length_in_waves) { return 1.0 / length_in_waves; }

double half_power_half_width(double length_in_waves) { return kHalfPower / length_in_waves; }

double half_power_width_rad(double length_in_waves, double steer_rad) {
  const double half = half_power_half_width(length_in_waves);
  const double upper = std::min(1.0, std::sin(steer_rad) + half);
  const double lower = std::max(-1.0, std::sin(steer_rad) - half);
  return std::asin(upper) - std::asin(lower);
}

double length_in_waves_for(double width_rad) { return kHalfPower / std::sin(0.5 * width_rad); }

double directivity_index_db(double length_in_waves, double width_in_waves) {
  return 10.0 * std::log10(4.0 * kPi * length_in_waves * width_in_waves);
}

std::complex<double> amplitude(const LineArray& array, double wavelength_m, double sine, double sin_steer) {
  const double phase = 2.0 * kPi * array.spacing_m / wavelength_m * (sine - sin_steer);
  const std::complex<double> step = std::polar(1.0, phase);
  std::complex<double> sum = 0.0;  // by Horner's rule, from the positive end
  double sum_of_weights = 0.0;
  for (auto w = array.weights.rbegin(); w != array.weights.rend(); ++w) {
    sum = sum * step + *w;
    sum_of_weights += *w;
  }
  const double element = sinc(array.element_length_m / wavelength_m * sine);
  return sum * std::polar(element / sum_of_weights, -0.5 * phase * (array.elements() - 1));
}

double power(const LineArray& array, double wavelength_m, double sine, double sin_steer) {
  return std::norm(amplitude(array, wavelength_m, sine, sin_steer));
}

BeamEdges half_power_edges(const std::function<double(double)>& pattern, double axis_sine, double step) {
  const double level = 0.5 * pattern(axis_sine);
  return {.lower_sine = crossing(pattern, axis_sine, -step, level),
          .upper_sine = crossing(pattern, axis_sine, step, level)};
}

BeamEdges half_power_edges(const LineArray& array, double wavelength_m, double sin_steer) {
  return half_power_edges([&](double u) { return power(array, wavelength_m, u, sin_steer); }, sin_steer,
                          std::min(0.01, wavelength_m / (64.0 * array.length_m())));
}

double half_power_width_rad(const LineArray& array, double wavelength_m, double sin_steer) {
  const BeamEdges edges = half_power_edges(array, wavelength_m, sin_steer);
  return std::asin(edges.upper_sine) - std::asin(edges.lower_sine);
}

double first_null(const LineArray& array, double wavelength_m) {
  const auto real = [&](double u) { return amplitude(array, wavelength_m, u).real(); };
  return crossing(real, 0.0, std::min(0.01, wavelength_m / (64.0 * array.length_m())), 0.0);
}

double equivalent_width(const LineArray& array, double wavelength_m, double sin_steer) {
  return integral_over_sine([&](double u) { return power(array, wavelength_m, u, sin_steer); },
                            cycles(array, wavelength_m));
}

double effective_length_m(const LineArray& array) {
  return array.spacing_m * std::pow(10.0, 0.1 * white_noise_gain_db(array.weights));
}

LineArray line_array_of_width(double width_rad, double wavelength_m, const Shading& shading, double spacing_in_waves) {
  if (!(width_rad > 0.0 && width_rad <= 0.5 * kPi)) {
    throw std::invalid_argument("a beam " + std::to_string(width_rad) + " rad wide: allowed above 0 to pi/2");
  }
  if (!(spacing_in_waves > 0.0 && spacing_in_waves <= 1.0)) {
    throw std::invalid_argument("elements " + std::to_string(spacing_in_waves) + " waves apart: allowed above 0 to 1");
  }
  // The pattern depends on spacing times sine alone, so the width of any spacing gives that of all others.
  const double half_sine = std::sin(0.5 * width_rad);
  const auto spacing_for = [&](int elements) {
    LineArray trial{.spacing_m = 0.01 * wavelength_m,
                    .weights = shading_weights(shading, elements),
                    .element_length_m = 0.01 * wavelength_m};
    const double unit = 100.0 / elements;  // sets the trial's half-power width well inside -1..1
    trial.spacing_m *= unit;
    trial.element_length_m *= unit;
    return trial.spacing_m * half_power_edges(trial, wavelength_m).upper_sine / half_sine;
  };
  constexpr int kTrialElements = 64, kAlwaysEven = 10;
  const double length_m = kTrialElements * spacing_for(kTrialElements);
  int elements = std::max(1, static_cast<int>(std::ceil(length_m / (spacing_in_waves * wavelength_m))));
  if (elements > kAlwaysEven) elements += elements % 2;
  const double spacing_m = spacing_for(elements);
  return {.spacing_m = spacing_m, .weights = shading_weights(shading, elements), .element_length_m = spacing_m};
}

SplitAperture split_aperture(const LineArray& array, double fraction) {
  const auto all = static_cast<std::size_t>(array.elements());
  const double wanted = fraction * static_cast<double>(all);
  if (!(wanted >= 1.0 && wanted < static_cast<double>(all))) {
    throw std::invalid_argument("a part of " + std::to_string(wanted) + " of " + std::to_string(all) +
                                " elements: at least 1, and not all");
  }
  const auto part = static_cast<std::ptrdiff_t>(wanted);
  SplitAperture split{.negative = array.weights, .positive = array.weights};
  std::fill(split.negative.begin() + part, split.negative.end(), 0.0);
  std::fill(split.positive.begin(), split.positive.end() - part, 0.0);
  split.baseline_m =
      array.spacing_m * (centre_of_gravity_elements(split.positive) - centre_of_gravity_elements(split.negative));
  return split;
}

PatternTable::PatternTable(const std::function<std::complex<double>(double sine)>& pattern, double reach_in_waves,
                           double error) {
  if (!(error >= 1e-6 && error <= 0.1)) {
    throw std::invalid_argument("a pattern table with an error of " + std::to_string(error) + ": allowed 1e-6 to 0.1");
  }
  const double step = std::pow(error * 128.0 / 3.0, 0.25) / (2.0 * std::numbers::pi * reach_in_waves);
  steps_ = static_cast<int>(std::ceil(2.0 / std::min(step, 0.5)));
  steps_per_sine_ = 0.5 * steps_;
  for (int i = -1; i < steps_ + 2; ++i) points_.emplace_back(pattern(i / steps_per_sine_ - 1.0));
}

PatternTable::PatternTable(const LineArray& array, double wavelength_m, double sin_steer, double error)
    : PatternTable([&](double u) { return array::amplitude(array, wavelength_m, u, sin_steer); },
                   0.5 * ((array.elements() - 1) * array.spacing_m + array.element_length_m) / wavelength_m, error) {}

std::shared_ptr<const PatternTable> uniform_line_table(double length_in_waves, double error) {
  return std::make_shared<const PatternTable>([=](double sine) { return line_amplitude(length_in_waves, sine); },
                                              0.5 * length_in_waves, error);
}

}  // namespace ensonify::array
