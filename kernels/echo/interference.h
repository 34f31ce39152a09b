#pragma once

#include <span>
#include <vector>

#include "kernels/echo/arrival.h"
#include "kernels/echo/pulse.h"

namespace ensonify::echo {

/// A transmission of another head, as it reaches this one: directly, or by way of the seabed.
struct ForeignTransmission {
  double time_s = 0.0;           // of its start, after the start of our own transmission; may be negative
  double source_level_db = 0.0;  // towards us by this path, re 1 uPa at 1 m: with its pattern and, for an echo by way
                                 // of the seabed, the target strength of what reflects it
  double frequency_hz = 0.0;
  double bandwidth_hz = 0.0;  // of its pulse: 1 / length for a tone
  double duration_s = 0.0;
  double path_m = 1.0;         // length of the path
  double spreading_db = 20.0;  // per decade of path: 20 direct, 40 for an echo whose legs are half the path each
  Eigen::Vector3f direction_head = Eigen::Vector3f::UnitX();  // to where it comes from, unit, our frame
};

/// What our receiver lets through.
struct ReceiverBand {
  double frequency_hz = 300e3;
  double bandwidth_hz = 10e3;  // flat within
  double rejection_db = 80.0;  // of what lies outside
  double sound_speed_mps = 1500.0;
  double absorption_dbpm = 0.07;  // at the foreign frequency, near enough
};

/// Share of the foreign pulse's energy that passes our filter: the overlap of the two bands over its own band, plus
/// what the rejection lets by; 0..1.
double band_overlap(const ForeignTransmission& foreign, const ReceiverBand& band);

/// Foreign transmissions as arrivals, appended: one after another, each one our pulse's length after the last, as long
/// as the foreign pulse lasts; their phase turns with the difference of frequencies. It shows at the slant range
/// c (time + path / c) / 2, the same in every ping while both heads keep time, and drifts when they do not.
void add_interference(std::span<const ForeignTransmission> transmissions, const ReceiverBand& band, const Pulse& pulse,
                      std::vector<Arrival>& arrivals);

}  // namespace ensonify::echo
