#include "kernels/instruments/sensors/instrument_clock.h"

#include <algorithm>

namespace ensonify::sensors {

bool within(const std::vector<Span>& spans, double t_s) {
  return std::any_of(spans.begin(), spans.end(),
                     [t_s](const Span& span) { return t_s >= span.from_s && t_s < span.to_s; });
}

double InstrumentClock::error_s(double t_s) const {
  if (!locked) return offset_s + 1e-6 * drift_ppm * t_s;
  double lost_at_s = t_s;  // walk back through spans that overlap or touch
  for (bool moved = true; moved;) {
    moved = false;
    for (const Span& span : unlocked) {
      if (span.from_s < lost_at_s && (lost_at_s < span.to_s || (lost_at_s == span.to_s && lost_at_s < t_s))) {
        lost_at_s = span.from_s;
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
