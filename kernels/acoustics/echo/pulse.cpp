#include "kernels/acoustics/echo/pulse.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>

namespace ensonify::echo {
namespace {

constexpr double kPi = std::numbers::pi;

void require_positive(double value, const char* name) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw std::invalid_argument(std::string(name) + " of a pulse is " + std::to_string(value) +
                                ": it must be positive");
  }
}

/// Tukey's window at x in 0..1.
double tukey(double x, double tapered_fraction) {
  const double edge = std::min(x, 1.0 - x);
  if (edge >= 0.5 * tapered_fraction) return 1.0;
  return 0.5 - 0.5 * std::cos(2.0 * kPi * std::max(edge, 0.0) / tapered_fraction);
}

/// Windows at x in 0..1, peak 1 [Harris1978].
double window_at(Window window, double x) {
  const double c1 = std::cos(2.0 * kPi * x), c2 = std::cos(4.0 * kPi * x);
  switch (window) {
    case Window::kNone: return 1.0;
    case Window::kHann: return 0.5 - 0.5 * c1;
    case Window::kHamming: return 0.54 - 0.46 * c1;
    case Window::kBlackman: return 0.42 - 0.5 * c1 + 0.08 * c2;
  }
  return 1.0;
}

/// Integral of w(t') e^(i pi (B / T) ((t' + lag)^2 - t'^2)) dt' over the overlap of sweep and reference, both from
/// -T/2 to T/2: the matched filter's output at `lag`, not yet scaled. Its magnitude, with the sign of its real part:
/// the rest of its phase comes of the window alone, and is small but for sweeps of few turns.
double correlation(double length_s, double bandwidth_hz, Window window, double lag_s) {
  const double rate = bandwidth_hz / length_s;
  const double from = std::max(-0.5 * length_s, -0.5 * length_s - lag_s);
  const double to = std::min(0.5 * length_s, 0.5 * length_s - lag_s);
  if (to <= from) return 0.0;
  // The integrand turns lag * rate times a second; sixteen points a turn and at least 256 in all: error below 1e-4.
  const int points = 256 + static_cast<int>(16.0 * std::abs(lag_s) * rate * (to - from));
  const double step = (to - from) / points;
  std::complex<double> sum;
  for (int i = 0; i < points; ++i) {
    const double t = from + (i + 0.5) * step;
    sum += window_at(window, t / length_s + 0.5) * std::polar(1.0, 2.0 * kPi * rate * lag_s * (t + 0.5 * lag_s));
  }
  return std::copysign(std::abs(sum), sum.real()) * step;
}

}  // namespace

double Pulse::at(double time_s) const {
  const double x = (time_s - start_s) / step_s;
  const auto last = static_cast<double>(envelope.size() - 1);
  if (!(x >= 0.0 && x < last)) return 0.0;
  const auto i = static_cast<std::size_t>(x);
  return envelope[i] + (x - static_cast<double>(i)) * (envelope[i + 1] - envelope[i]);
}

double Pulse::end_s() const { return start_s + step_s * static_cast<double>(envelope.size() - 1); }

double Pulse::equivalent_length_s() const {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < envelope.size(); ++i) {  // exact for straight lines between entries
    const double a = envelope[i], b = envelope[i + 1];
    sum += (a * a + a * b + b * b) / 3.0;
  }
  return sum * step_s;
}

void Pulse::check_period(double period_s) const {
  const double longest = 0.5 / bandwidth_hz;
  if (!(period_s > 0.0 && period_s <= longest * (1.0 + 1e-9))) {
    throw std::invalid_argument("a sample period of " + std::to_string(1e6 * period_s) +
                                " us does not suit the pulse: at most " + std::to_string(1e6 * longest) +
                                " us are allowed");
  }
}

Pulse rectangular_pulse(double length_s) {
  require_positive(length_s, "the length");
  return {length_s, 0.0, length_s, {1.0, 1.0}, 1.0 / length_s, 1.0 / length_s, 0.0};
}

Pulse tapered_pulse(double length_s, double tapered_fraction) {
  require_positive(length_s, "the length");
  if (!(tapered_fraction >= 0.0 && tapered_fraction <= 1.0)) {
    throw std::invalid_argument("the tapered fraction of a pulse must lie between 0 and 1");
  }
  if (tapered_fraction == 0.0) return rectangular_pulse(length_s);
  constexpr int kSteps = 512;
  Pulse pulse{length_s, 0.0, length_s / kSteps, {}, 1.0 / length_s, 0.0, 0.0};
  for (int i = 0; i <= kSteps; ++i) pulse.envelope.push_back(tukey(static_cast<double>(i) / kSteps, tapered_fraction));
  pulse.noise_bandwidth_hz = 1.0 / pulse.equivalent_length_s();
  return pulse;
}

Pulse compressed_chirp(double length_s, double bandwidth_hz, Window window, double dynamic_range_db) {
  require_positive(length_s, "the length");
  require_positive(bandwidth_hz, "the bandwidth");
  require_positive(dynamic_range_db, "the dynamic range");
  if (bandwidth_hz * length_s < 4.0) {
    throw std::invalid_argument("a chirp of bandwidth x length " + std::to_string(bandwidth_hz * length_s) +
                                " is no sweep: at least 4 are needed");
  }
  constexpr double kStepsPerResolution = 16.0;
  const double step = 1.0 / (kStepsPerResolution * bandwidth_hz);
  const double least = std::pow(10.0, -0.05 * dynamic_range_db);
  const double peak = correlation(length_s, bandwidth_hz, window, 0.0);
  // The longest tail that a side lobe above `least` can have is that of sinc, 1 / (pi B t).
  const int reach =
      static_cast<int>(std::min(length_s, 1.0 / (kPi * bandwidth_hz * least) + 3.0 / bandwidth_hz) / step);
  std::vector<double> half;
  std::size_t kept = 1;
  for (int i = 0; i <= reach; ++i) {
    half.push_back(correlation(length_s, bandwidth_hz, window, i * step) / peak);
    if (std::abs(half.back()) > least) kept = half.size();
  }
  half.resize(kept);
  half.push_back(0.0);
  Pulse pulse{length_s, -step * static_cast<double>(kept), step, {}, bandwidth_hz, 0.0, 0.0};
  pulse.envelope.assign(half.rbegin(), half.rend());
  pulse.envelope.insert(pulse.envelope.end(), half.begin() + 1, half.end());

  double sum = 0.0, squares = 0.0;  // of the reference
  constexpr int kPoints = 4096;
  for (int i = 0; i < kPoints; ++i) {
    const double w = window_at(window, (i + 0.5) / kPoints);
    sum += w / kPoints;
    squares += w * w / kPoints;
  }
  pulse.noise_bandwidth_hz = squares / (sum * sum * length_s);
  pulse.processing_gain_db = 10.0 * std::log10(bandwidth_hz / pulse.noise_bandwidth_hz);
  return pulse;
}

SampledPulse::SampledPulse(const Pulse& pulse, double period_s) : start_in_periods_(pulse.start_s / period_s) {
  pulse.check_period(period_s);
  support_ = static_cast<int>(std::ceil((pulse.end_s() - pulse.start_s) / period_s - 1e-9));
  for (int phase = 0; phase < kPhases; ++phase) {
    for (int k = 0; k < support_; ++k) {
      const double after_start = (k + (phase + 0.5) / kPhases) * period_s;
      table_.push_back(static_cast<float>(pulse.at(pulse.start_s + after_start)));
    }
  }
  // The mean over where an echo may begin: a last sample that a pulse reaches now and then counts as often.
  response_.assign(static_cast<std::size_t>(support_), 0.0F);
  for (std::size_t i = 0; i < table_.size(); ++i) response_[i % response_.size()] += table_[i] / kPhases;
  float energy = 0.0F;
  for (const float r : response_) energy += r * r;
  for (float& r : response_) r /= std::sqrt(energy);
}

SampledPulse SampledPulse::squared() const {
  SampledPulse power = *this;
  for (float& value : power.table_) value *= value;
  return power;
}

}  // namespace ensonify::echo
