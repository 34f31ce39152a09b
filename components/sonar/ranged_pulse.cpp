#include "components/sonar/ranged_pulse.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "components/config/config_reader.h"

namespace ensonify {
namespace {

constexpr double kLeastSweep = 4.000001;  // bandwidth x length: over the 4 that echo::compressed_chirp asks for

}  // namespace

void PulseDesign::check(const ConfigReader& from) const {
  check_taper(from, chirp, tapered_fraction);
  if (length_s > longest_s) {
    from.problem("pulse_length_s", "is beyond longest_pulse_length_s, " + std::to_string(longest_s) + " s");
  }
}

RangedPulse pulse_at(const PulseDesign& design, double range_m, double sound_speed_mps, double held_s) {
  const double reception_s = 2.0 * range_m / sound_speed_mps;
  const double length_s = held_s > 0.0 ? held_s : design.length_s;
  RangedPulse pulse;
  pulse.band_hz = std::min(design.chirp ? design.bandwidth_hz : 1.0 / length_s,
                           design.most_samples / (design.samples_per_pulse * reception_s));
  pulse.length_s = design.chirp ? std::max(length_s, kLeastSweep / pulse.band_hz) : 1.0 / pulse.band_hz;
  pulse.sampling.period_s = 1.0 / (design.samples_per_pulse * pulse.band_hz);
  const double samples = std::ceil(reception_s / pulse.sampling.period_s - 1e-6);
  pulse.sampling.count = std::clamp(static_cast<int>(samples), 1, design.most_samples);
  return pulse;
}

void allow_held_pulses(const PulseDesign& design, double sound_speed_mps, SettingLimits& limits) {
  const double shortest_s = design.chirp ? kLeastSweep / design.bandwidth_hz : design.length_s;
  limits["pulse_length_s"] = {{shortest_s, design.longest_s}, true};
  limits.shortest_pulse_s = [=](double range_m) {
    return pulse_at(design, range_m, sound_speed_mps, shortest_s).length_s;
  };
}

/// Samples end less than a period after the range; the longest pulse has the longest period.
double longest_reception_s(const PulseDesign& design, double longest_range_m, double sound_speed_mps) {
  const RangedPulse longest = pulse_at(design, longest_range_m, sound_speed_mps, design.longest_s);
  return 2.0 * longest_range_m / sound_speed_mps + longest.sampling.period_s + longest.length_s;
}

echo::Pulse echo_pulse(const PulseDesign& design, const RangedPulse& pulse) {
  return design.chirp ? echo::compressed_chirp(pulse.length_s, pulse.band_hz, design.window)
                      : echo::tapered_pulse(pulse.length_s, design.tapered_fraction);
}

void check_taper(const ConfigReader& from, bool chirp, double tapered_fraction) {
  if (chirp && tapered_fraction != 0.0) from.problem("tapered_fraction", "is of tones; chirps have a window");
}

void fill_shape(bool chirp, double tapered_fraction, msg::AppliedSettings& applied) {
  applied.pulse = chirp ? "fm_up" : (tapered_fraction > 0.0 ? "cw_tapered" : "cw");
  applied.tapered_fraction = tapered_fraction;
}

}  // namespace ensonify
