#include "kernels/instruments/sensors/instrument_clock.h"

namespace ensonify::sensors {

bool within(const std::vector<double>& ends_s, double t_s) {
  bool inside = false;
  for (std::size_t i = 0; i + 1 < ends_s.size(); i += 2) inside = inside || (t_s >= ends_s[i] && t_s < ends_s[i + 1]);
  return inside;
}

double InstrumentClock::error_s(double t_s) const {
  if (!locked) return offset_s + 1e-6 * drift_ppm * t_s;
  double lost_at_s = t_s;  // walk back through spans that overlap or touch
  for (bool moved = true; moved;) {
    moved = false;
    for (std::size_t i = 0; i + 1 < unlocked_s.size(); i += 2) {
      const double from_s = unlocked_s[i], to_s = unlocked_s[i + 1];
      if (from_s < lost_at_s && (lost_at_s < to_s || (lost_at_s == to_s && lost_at_s < t_s))) {
        lost_at_s = from_s;
        moved = true;
      }
    }
  }
  return residual_s + 1e-6 * drift_ppm * (t_s - lost_at_s);
}

double InstrumentClock::stamp_s(double t_s, double latency_s, Stamping stamping) const {
  const double stamped_s = stamping == Stamping::kOutput ? t_s + latency_s : t_s;
  return stamped_s + error_s(stamped_s);
}

}  // namespace ensonify::sensors
