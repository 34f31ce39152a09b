#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/base/frames/attitude.h"
#include "kernels/base/random/stream.h"

/// Doppler logs: four beams slanted about down (a Janus), each measuring velocity along itself, of the seabed (DVL) or
/// of layers of water (ADCP).
namespace ensonify::sensors {

struct JanusGeometry {
  double slant_rad = 0.5235987755982988;         // of each beam from down: 30 degrees
  double first_azimuth_rad = 0.785398163397448;  // of beam 0 from forward to starboard; the others follow by quarters

  /// Unit vectors from the transducer outwards, in its own frame (forward, starboard, down).
  std::array<frames::Vec3, 4> directions() const;
};

struct DopplerErrors {
  double beam_white_mps = 0.0;    // of one beam's single ping, plus
  double beam_white_share = 0.0;  // this share of its radial speed
  double scale = 0.0;             // standard deviation, drawn once: beam angles, sound speed at the face
  double dropout = 0.0;           // probability that a beam's ping fails though the bottom is in range
  double shortest_m = 0.5;        // range along a beam
  double longest_m = 200.0;
};

struct DopplerReading {
  bool valid = false;                                // at least three beams; else velocity means nothing
  frames::Vec3 velocity_mps = frames::Vec3::Zero();  // of the transducer, its own axes, over what was tracked
  frames::Vec3 sigma_mps = frames::Vec3::Zero();     // as the instrument states it, from white noise
  double error_velocity_mps = 0.0;                   // what four beams disagree about; 0 with three
  std::array<std::optional<double>, 4> range_m;      // of beams with lock
  std::optional<double> altitude_m;                  // mean of their ranges down
};

class DopplerLog {
 public:
  DopplerLog(const JanusGeometry& geometry, const DopplerErrors& errors, const random::Stream& stream);

  const std::array<frames::Vec3, 4>& directions() const { return directions_; }

  /// Ping n over the bottom. `velocity_mps` is the transducer's true velocity over ground along its axes; ranges are
  /// true distances to the seabed along the beams, empty where there is none.
  DopplerReading bottom_track(const frames::Vec3& velocity_mps, const std::array<std::optional<double>, 4>& range_m,
                              std::uint64_t n) const;

  /// Ping n against a layer of water, `relative_mps` the transducer's true velocity through it. No lock is needed.
  DopplerReading water_track(const frames::Vec3& relative_mps, std::uint64_t n) const;

 private:
  DopplerReading solve(const frames::Vec3& velocity_mps, const std::array<bool, 4>& lock, std::uint64_t n,
                       std::uint64_t lane) const;

  std::array<frames::Vec3, 4> directions_;
  DopplerErrors errors_;
  random::Stream stream_;
};

/// Bins of a current profiler: layers of equal thickness below the transducer.
struct BinLayout {
  double blanking_m = 1.0;  // depth below the transducer at which the first begins
  double thickness_m = 1.0;
  int count = 30;

  double middle_m(int bin) const { return blanking_m + (bin + 0.5) * thickness_m; }
};

struct BinReading {
  double depth_below_m;       // of the bin's middle under the transducer
  frames::Vec3 velocity_mps;  // of the water past the transducer
  double sigma_mps;           // stated, each horizontal axis
};

/// One ensemble of a current profiler, ping n: velocities of the water past the transducer, its own axes.
/// `relative_mps[i]` is the true velocity of the water in bin i less the transducer's. Bins below the last whole one
/// above the bottom are left out: side lobes straight down reach the bottom when slanted beams are at
/// cos(slant) of its distance, and drown what lies below.
std::vector<BinReading> profile_current(const JanusGeometry& geometry, const DopplerErrors& errors,
                                        const BinLayout& layout, const std::vector<frames::Vec3>& relative_mps,
                                        std::optional<double> altitude_m, const random::Stream& stream,
                                        std::uint64_t n);

}  // namespace ensonify::sensors
