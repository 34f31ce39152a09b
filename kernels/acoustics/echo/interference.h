#pragma once

#include <span>
#include <vector>

#include "kernels/acoustics/echo/arrival.h"
#include "kernels/acoustics/echo/pulse.h"

namespace ensonify::echo {

/// A transmission of another head by one path: straight from it, or from its mirror image in the seabed.
struct InterferingTransmission {
  double time_s = 0.0;                                // of its start, after the start of ours; may be negative
  frames::Vec3 source_enu_m = frames::Vec3::UnitX();  // of the source or its image, from where we are then
  double source_level_db = 0.0;                       // towards us by this path, re 1 uPa at 1 m, less its losses
  double frequency_hz = 0.0;
  double sweep_hz = 0.0;  // band that it sweeps upwards; 0: a tone
  double duration_s = 0.0;
  double rejection_db = 80.0;  // by our receiver, of what lies outside its band
};

/// The receiver, besides its pulse.
struct ReceiverBand {
  double frequency_hz = 300e3;  // the pulse's band lies about it
  double sound_speed_mps = 1500.0;
  double absorption_dbpm = 0.07;  // at the foreign frequency, near enough
  Sum sum = Sum::kPressure;
};

/// Interfering pulse behind our filter.
struct Passed {
  double start_s = 0.0;     // after its arrival; less than 0 where a chirp's filter, whose delay is taken out, receives
                            // its upper band
  double duration_s = 0.0;  // at least that of an echo of ours
  double power = 0.0;       // of the mean square at the receiver; 0..1
};

/// Energy is kept: of the foreign pulse's, the share that lies in our band passes, and a matched filter leaves of it
/// its noise bandwidth over its bandwidth. It is spread evenly over the time in which the parts of that band come out:
/// those of a sweep pass one after another, and a filter matched to a sweep delays each differently [Klauder1960]. A
/// pulse like our own comes out as an echo does; a tone behind a chirp's filter 1 / (B T) as strong, over all of T.
/// What lies outside the band is weakened by the rejection and keeps its length.
Passed through_filter(const InterferingTransmission& interfering, const ReceiverBand& band, const Pulse& pulse);

/// Echoes of another transmission of the same head, as its own receiver for that transmission hits them (`echoes`:
/// times after `other`'s own start), appended as our filter receives them. What passes is spread over the time in which
/// the filter lets it out: one arrival an echo, each at another place of that time, with all of its energy. The line's
/// delays are made for our frequency: directions are scaled by the ratio of both, as the phase between elements is.
/// Source and its level are the echoes' own and not examined.
void add_echoes_of(const InterferingTransmission& other, const Arrivals& echoes, const ReceiverBand& band,
                   const Pulse& pulse, Arrivals& arrivals);

/// Foreign transmissions as arrivals, appended: one after another, each an echo's length after the last, as long as
/// what passes the filter lasts; their phase turns with the difference of frequencies. Level: source level - 20 log R -
/// alpha R. It shows at the slant range c (time + R / c) / 2, the same in every ping while both heads keep time, and
/// drifts when they do not.
void add_interference(std::span<const InterferingTransmission> transmissions, const ReceiverBand& band,
                      const Pulse& pulse, const Receivers& receivers, Arrivals& arrivals);

}  // namespace ensonify::echo
