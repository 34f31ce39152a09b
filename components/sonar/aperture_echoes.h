#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "components/sonar/sea_acoustics.h"
#include "kernels/acoustics/array/pattern.h"
#include "kernels/acoustics/echo/aperture.h"
#include "kernels/acoustics/echo/pulse.h"
#include "kernels/acoustics/echo/speckle_cells.h"
#include "kernels/acoustics/echo/volume.h"
#include "kernels/acoustics/trace/ray_distribution.h"
#include "kernels/base/random/stream.h"

namespace ensonify {

/// Patterns of transducers of one frequency, the same of each in the same place.
struct AperturePatterns {
  std::vector<array::Pattern> transmit, receive;
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

/// Echoes of one transmission as each aperture receives them, by the true motion and the true water: seabed, surface,
/// water column, other transmissions and noise. The twin of ArrayEchoes.
class ApertureEchoes {
 public:
  /// `rays` are those of its transmissions.
  ApertureEchoes(const Apertures& apertures, std::shared_ptr<const Environment> environment, const Effects& effects,
                 const Quality& quality, const trace::RayDistribution& rays);

  /// Memory of the caller: results lie in it until it is used again.
  struct Memory {
    echo::Image image;
    // Scratch.
    ShotMemory shot;
    echo::Arrivals foreign;
    std::vector<float> gain, foreign_gain, volume_upa2;
    echo::TimeIndex index;
    echo::RowBackground background;
  };
  struct Received {
    echo::Image& image;  // complex envelopes, aperture by sample, uPa rms
    TraceSummary trace;
  };

  /// All stages of a ping, a function of the emission, the poses and the tiles. `poses` are where the head truly is
  /// from transmission on, one per kTrackPeriod.
  Received receive_echoes(const Emission& emission, const echo::Pulse& pulse, std::span<const frames::HeadPose> poses,
                          const trace::Scene& seabed, Memory& memory) const;

 private:
  echo::EchoSet weighed(const echo::Arrivals& arrivals, const echo::PairedArrivals& paired,
                        const frames::HeadPose& pose, std::vector<float>& gain) const;
  void beamform(std::span<const echo::EchoSet> echoes, const echo::SampledPulse& pulse, const echo::Sampling& sampling,
                Memory& memory) const;
  double noise_db(const echo::Pulse& pulse) const;

  Apertures apertures_;
  Effects effects_;
  random::Stream noise_, volume_;
  SeaAcoustics sea_;
  echo::SpeckleCells cells_;
  trace::RayDistribution distribution_;
  std::vector<echo::VolumeDirections> volume_directions_;  // by aperture; empty: the water does not scatter
};

}  // namespace ensonify
