#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "components/sonar/arrivals.h"
#include "components/sonar/ping_event.h"
#include "kernels/acoustics/echo/aperture.h"
#include "kernels/acoustics/echo/pulse.h"
#include "kernels/acoustics/echo/scatterer.h"
#include "kernels/acoustics/echo/volume.h"
#include "kernels/acoustics/trace/ray_distribution.h"
#include "kernels/base/random/stream.h"

namespace ensonify {

/// Amplitude that a transducer gives a direction (unit vector, head frame) to or from a point at this range, besides
/// spreading; 1 on its axis far away (range infinite).
using AperturePattern = std::function<float(const Eigen::Vector3f& direction_head, float range_m)>;

/// Patterns of transducers of one frequency, the same of each in the same place.
struct AperturePatterns {
  std::vector<AperturePattern> transmit, receive;
};

/// Transducers of one frequency that send at once and of which each receives for itself: both sides of a sidescan, the
/// one face of an echosounder.
struct Apertures {
  double frequency_hz = 0.0;
  AperturePatterns patterns;
  double directivity_index_db = 0.0;                            // of each, against noise from all directions
  double electronic_noise_db = -200.0;                          // as sound in the water, dB re 1 uPa^2/Hz
  double narrowest_rad = 0.01;                                  // half-power width of the narrowest lobe
  Eigen::Vector3f narrow_axis_head = Eigen::Vector3f::UnitX();  // along which it is narrow
  double nearest_m = 10.0;      // range down to which patches of seabed must be finer than the lobe
  double resolution_m = 0.075;  // in range
  std::uint64_t seed = 1;
  std::string process;  // names the streams of random numbers, with the frequency
};

/// Settings of one ping.
struct Emission {
  PingEvent event;
  double source_level_db = 0.0;
  double reception_s = 0.0;        // after transmission
  double sample_period_s = 50e-6;  // of the complex envelope
};

/// The echoes of one transmission as each aperture receives them, by the true motion and the true water: seabed,
/// surface, water column and noise. A function of the emission, the poses and the tiles.
class ApertureEchoes {
 public:
  /// `rays` are those of its transmissions.
  ApertureEchoes(const Apertures& apertures, const Environment& environment, const Effects& effects,
                 const trace::RayDistribution& rays);

  /// Complex envelopes, aperture by sample, uPa rms; valid until the next call. `poses` are where the head truly is
  /// from transmission on, one per kTrackPeriod. The seabed's mesh becomes that of this transmission.
  echo::Image& receive_echoes(const Emission& emission, const echo::Pulse& pulse,
                              std::span<const frames::HeadPose> poses, trace::Scene& seabed);

  /// Arrivals of the last ping, with its hits.
  const Arrivals& arrivals() const { return arrivals_; }

 private:
  void beamform(std::span<const echo::Arrival> arrivals, const echo::SampledPulse& pulse,
                const echo::Sampling& sampling);
  void add_noise(const Emission& emission, const echo::Pulse& pulse);

  Apertures apertures_;
  Effects effects_;
  random::Stream noise_, volume_;
  Arrivals arrivals_;
  echo::Scatterers scatterers_;
  trace::RayDistribution distribution_;
  echo::ApertureReceiver receiver_;
  echo::RowReverberation reverberation_;
  std::vector<echo::VolumeDirections> volume_directions_;  // by aperture; empty: the water does not scatter

  // Memory of the ping path.
  std::vector<trace::Ray> rays_;
  std::vector<trace::Hit> hits_;
  std::vector<std::vector<float>> gains_;
  echo::Image image_;
};

}  // namespace ensonify
