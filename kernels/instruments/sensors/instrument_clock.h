#pragma once

#include <vector>

namespace ensonify::sensors {

/// Whether t lies in any of the spans [from, to), of which `ends_s` has from, to, from, to ...
bool within(const std::vector<double>& ends_s, double t_s);

/// Moment at which an instrument stamps its measurement.
enum class Stamping {
  kMeasurement,  // the moment that the value belongs to
  kOutput        // the moment that the message leaves, later by the latency; nothing says by how much
};

/// An instrument's own clock. Locked to 1PPS and ZDA it shows time of day to within the lock's residual; free, it goes
/// wrong by its drift from where it was when the lock was lost. Never locked, it starts with its offset.
struct InstrumentClock {
  double offset_s = 0.0;           // shown less true, at sim time 0, when never locked
  double drift_ppm = 0.0;          // of the free oscillator
  bool locked = true;              // 1PPS and ZDA are wired
  double residual_s = 0.0;         // shown less true while locked: cable delay, pulse width, wrong edge
  std::vector<double> unlocked_s;  // the pulse is lost: from, to, from, to ...

  /// Shown less true at sim time t.
  double error_s(double t_s) const;

  /// Stamp of a value measured at t and sent `latency` later.
  double stamp_s(double t_s, double latency_s, Stamping stamping) const;
};

}  // namespace ensonify::sensors
