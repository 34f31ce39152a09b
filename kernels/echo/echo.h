#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/echo/image.h"
#include "kernels/frames/pose.h"
#include "kernels/random/stream.h"
#include "kernels/trace/fan.h"
#include "kernels/trace/scene.h"

/// From hits on the seabed to what each beam hears: the sonar equation in its ray form.
namespace ensonify::echo {

/// A Mills cross and the water it works in (isovelocity).
struct Sonar {
  double source_level_db = 220.0;          // rms during the pulse, re 1 uPa at 1 m, on the transmit axis
  double pulse_length_s = 100e-6;          // rectangular
  double transmit_length_in_waves = 50.0;  // L / lambda, uniform line along the head's x axis
  double receive_length_in_waves = 50.0;   // L / lambda, uniform line along the head's y axis
  double receive_reach = 6.0;  // how far off its axis a beam listens, sine in lambda / L; 1 is the first null
  double sound_speed_mps = 1500.0;
  double absorption_dbpm = 0.07;
};

/// Where the receiver is while echoes come back: poses at start_s + i * period_s after transmission, straight lines
/// between, the nearest one outside.
struct ReceiveTrack {
  double start_s = 0.0;
  double period_s = 1.0;
  std::span<const frames::HeadPose> poses;  // one is enough for a receiver at rest
};

/// One transmission and what its rays met. The three spans have one entry per ray.
struct Transmission {
  std::uint64_t ping = 0;
  std::span<const trace::Ray> rays;
  std::span<const trace::Hit> hits;
  std::span<const float> backscatter;  // scattering cross section per unit area at each hit, a ratio (seabed kernel)
};

/// Memory that `accumulate` reuses: sized by the first ping, then no more allocations for pings of that size.
class Workspace {
 public:
  /// What one ray brings back.
  struct Arrival {
    float re_upa, im_upa;        // complex pressure, before the receive pattern
    float sine;                  // of the angle from the plane across the receive array, at arrival
    float sin_phase, cos_phase;  // of pi L / lambda * sine
    std::int32_t first, end;     // samples that the pulse covers
  };
  std::vector<Arrival> unsorted, arrivals;  // arrivals: by sine
  std::vector<std::uint32_t> bin_start;
};

/// Adds up the echoes of one ping in every beam.
///
/// A ray of solid angle dOmega that meets the seabed at grazing angle theta lights dA = R^2 dOmega / sin(theta), so it
/// brings back the mean-square pressure p0^2 b_T b_R sigma 10^(-alpha (R + R') / 10) dOmega / (R'^2 sin(theta)), R out
/// and R' back (spreading is counted once). Its phase is uniform in [0, 2 pi), from (ping, ray), so
/// the sum has the speckle of an incoherent seabed when some ten rays share a resolution cell. It lasts for the pulse
/// from its arrival (R + R') / c on. The receiver's place and attitude are those at 2 R / c, which differs from the
/// arrival by under 0.1 us at 5 m/s and 100 m.
///
/// sin_beams: sines of the beams' axes in the receive array's cone angle, true (after steering errors), any order.
/// The sum runs ray by ray in a fixed order for each beam: the same bits for any number of threads. image is resized
/// and overwritten. Rays without hit and echoes outside the sampled time are left out.
void accumulate(const Sonar& sonar, std::span<const float> sin_beams, const Sampling& sampling,
                const Transmission& transmission, const ReceiveTrack& receiver, const random::Stream& phase,
                Workspace& workspace, Image& image);

/// Magnitude of the envelope, uPa rms, beam by sample; resized.
void amplitude_upa(const Image& image, std::vector<float>& amplitude);

}  // namespace ensonify::echo
