#include "components/runtime/head/ranged_pulse.h"

#include <algorithm>
#include <cmath>

namespace ensonify {
namespace {

constexpr double kLeastSweep = 4.000001;  // bandwidth x length: over the 4 that echo::compressed_chirp asks for

}  // namespace

RangedPulse pulse_at(const PulseDesign& design, double range_m, double sound_speed_mps) {
  const double listening_s = 2.0 * range_m / sound_speed_mps;
  RangedPulse pulse;
  pulse.band_hz = std::min(design.chirp ? design.bandwidth_hz : 1.0 / design.length_s,
                           design.most_samples / (design.samples_per_pulse * listening_s));
  pulse.length_s = design.chirp ? std::max(design.length_s, kLeastSweep / pulse.band_hz) : 1.0 / pulse.band_hz;
  pulse.sampling.period_s = 1.0 / (design.samples_per_pulse * pulse.band_hz);
  const double samples = std::ceil(listening_s / pulse.sampling.period_s - 1e-6);
  pulse.sampling.count = std::clamp(static_cast<int>(samples), 1, design.most_samples);
  return pulse;
}

echo::Pulse echo_pulse(const PulseDesign& design, const RangedPulse& pulse) {
  return design.chirp ? echo::compressed_chirp(pulse.length_s, pulse.band_hz, design.window)
                      : echo::rectangular_pulse(pulse.length_s);
}

}  // namespace ensonify
