#include "kernels/detect/bottom.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ensonify::detect {
namespace {

/// One beam's power against time.
struct Trace {
  std::span<const float> amplitude;
  double start_s, period_s;

  double power(int k) const {
    const double a = amplitude[static_cast<std::size_t>(k)];
    return a * a;
  }
  double time_s(int k) const { return start_s + k * period_s; }
  int samples() const { return static_cast<int>(amplitude.size()); }
  int index_from(double t_s) const {  // the first sample at or after t
    return static_cast<int>(std::clamp(std::ceil((t_s - start_s) / period_s), 0.0, static_cast<double>(samples())));
  }
};

double noise_power(const Trace& trace) {
  std::array<float, 256> some;
  const int stride = std::max(1, (trace.samples() + 255) / 256);
  std::size_t count = 0;
  for (int k = 0; k < trace.samples() && count < some.size(); k += stride) {
    some[count++] = trace.amplitude[static_cast<std::size_t>(k)];
  }
  if (count == 0) return 0.0;
  const auto middle = some.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(some.begin(), middle, some.begin() + static_cast<std::ptrdiff_t>(count));
  return static_cast<double>(*middle) * *middle / std::numbers::ln2;
}

struct Peak {
  double power = 0.0;   // mean over a pulse
  double time_s = 0.0;  // middle of that pulse
};

Peak strongest(const Trace& trace, const Settings& settings) {
  const int pulse = std::max(1, static_cast<int>(std::lround(settings.pulse_length_s / trace.period_s)));
  const int first = trace.index_from(settings.search_start_s), end = trace.index_from(settings.search_end_s);
  Peak peak;
  double sum = 0.0;
  for (int k = first; k < end; ++k) {
    sum += trace.power(k);
    if (k - first >= pulse) sum -= trace.power(k - pulse);
    if (k - first + 1 >= pulse && sum / pulse > peak.power) {
      peak = {sum / pulse, trace.time_s(k) - 0.5 * (pulse - 1) * trace.period_s};
    }
  }
  return peak;
}

/// How long the half-power footprint of a beam echoes on a level seabed, plus the pulse.
double footprint_s(double t_s, double sin_beam, const Settings& settings) {
  const double half =
      0.442946 / settings.receive_length_in_waves;  // half-power half width in sine, as in kernels/array
  const double cosine = std::sqrt(std::max(1.0 - sin_beam * sin_beam, half * half));
  return t_s * std::abs(sin_beam) * 2.0 * half / (cosine * cosine) + settings.pulse_length_s;
}

struct Gravity {
  double time_s = 0.0;    // centre
  double spread_s = 0.0;  // standard deviation of the power about it
  bool found = false;
};

Gravity centre_of_gravity(const Trace& trace, double middle_s, double half_window_s, double noise,
                          const Settings& settings) {
  const double loss_np_ps = 0.1 * settings.absorption_dbpm * std::numbers::ln10 * settings.sound_speed_mps;
  const int end = trace.index_from(middle_s + half_window_s);
  double weight = 0.0, inverse_square = 0.0, first_moment = 0.0, second_moment = 0.0;
  for (int k = trace.index_from(middle_s - half_window_s); k < end; ++k) {
    const double t = trace.time_s(k) - 0.5 * settings.pulse_length_s;
    if (t <= 0.0) continue;
    const double ratio = t / middle_s;
    const double w = (trace.power(k) - noise) * ratio * ratio * std::exp(loss_np_ps * (t - middle_s));
    weight += w;
    inverse_square += w / (ratio * ratio);
    first_moment += w * (t - middle_s);
    second_moment += w * (t - middle_s) * (t - middle_s);
  }
  if (!(weight > 0.0) || !(inverse_square > 0.0)) return {};
  const double mean = first_moment / weight;
  return {middle_s * std::sqrt(weight / inverse_square), std::sqrt(std::max(second_moment / weight - mean * mean, 0.0)),
          true};
}

Detection detect_in(const Trace& trace, double sin_beam, const Settings& settings) {
  Detection detection;
  const double noise = noise_power(trace);
  const Peak peak = strongest(trace, settings);
  if (!(peak.power > 0.0)) return detection;
  detection.snr_db = static_cast<float>(10.0 * std::log10(peak.power / std::max(noise, 1e-12 * peak.power)));
  if (detection.snr_db < settings.gate_db) return detection;

  Gravity gravity{peak.time_s - 0.5 * settings.pulse_length_s, 0.0, true};
  if (gravity.time_s <= 0.0) return detection;
  double half_window_s = 0.0;
  for (int pass = 0; pass < 4 && gravity.found; ++pass) {
    half_window_s = footprint_s(gravity.time_s, sin_beam, settings);
    gravity = centre_of_gravity(trace, gravity.time_s, half_window_s, noise, settings);
  }
  if (!gravity.found) return detection;

  double energy = 0.0;  // over a wider window, so that the pattern's skirts count
  const int end = trace.index_from(gravity.time_s + 2.5 * half_window_s);
  for (int k = trace.index_from(gravity.time_s - 2.5 * half_window_s); k < end; ++k) energy += trace.power(k) - noise;

  detection.valid = true;
  detection.two_way_s = gravity.time_s;
  detection.echo_energy_db = static_cast<float>(10.0 * std::log10(std::max(energy * trace.period_s, 1e-30)));
  // Speckle of one pulse is one independent sample; a box of standard deviation s is s sqrt(12) long.
  const double spread_s = std::max(gravity.spread_s, settings.pulse_length_s / std::sqrt(12.0));
  const double independent = std::max(1.0, spread_s * std::sqrt(12.0) / settings.pulse_length_s);
  detection.quality = static_cast<float>(-std::log10(spread_s / std::sqrt(independent) / gravity.time_s));
  return detection;
}

}  // namespace

void detect_bottom(const Settings& settings, std::span<const float> sin_beams, const Amplitudes& image,
                   std::vector<Detection>& detections) {
  detections.resize(sin_beams.size());
  const auto samples = static_cast<std::size_t>(image.samples);
  tbb::parallel_for(std::size_t{0}, sin_beams.size(), [&](std::size_t beam) {
    const Trace trace{image.amplitude_upa.subspan(beam * samples, samples), image.start_s, image.period_s};
    detections[beam] = detect_in(trace, sin_beams[beam], settings);
  });
}

double beam_area_m2(double range_m, double sin_beam, double transmit_length_in_waves, double receive_length_in_waves) {
  return range_m * range_m / (transmit_length_in_waves * receive_length_in_waves * (1.0 - sin_beam * sin_beam));
}

}  // namespace ensonify::detect
