#pragma once

#include <cstdint>
#include <vector>

#include "kernels/acoustics/trace/ray.h"
#include "kernels/base/frames/attitude.h"
#include "kernels/base/random/stream.h"

namespace ensonify::trace {

/// What a Mills cross transmits into: narrow along-track, wide across-track.
struct FanShape {
  double transmit_length_in_waves = 50.0;  // L / lambda of the line array along the head's x axis
  double along_reach = 8.0;                // sine to which rays go fore and aft, in lambda / L; 1 is the first null
  double half_swath_rad = 1.2;             // to port and starboard of the head's z axis, < pi/2
  int along = 24;                          // rays along-track
  int across = 1024;                       // rays across-track
  double grazing_share =
      0.7;  // share of the rows spread equally in slant range on a flat seabed; the rest equally in angle
};

/// Rays over the transmit volume of a Mills cross, a fixed number whatever they hit: what tests and benchmarks send
/// where heads ask the seabed (kernels/acoustics/trace/ray_distribution.h).
///
/// A direction is (u, sqrt(1-u^2) sin phi, sqrt(1-u^2) cos phi): u the sine of the along-track angle, phi the
/// across-track angle about the head's x axis. Then dOmega = du dphi exactly. The volume is cut into along x across
/// strata; each holds one ray at a random place that depends on (seed, ping, ray) only, so means over pings are
/// unbiased. Strata are narrow in u where the transmit pattern is high (edges on a Cauchy distribution, the envelope of
/// sinc^2) and narrow in phi towards grazing.
class Fan {
 public:
  /// Throws std::invalid_argument for a shape without rays or a swath of 180 degrees or more.
  explicit Fan(const FanShape& shape);

  std::size_t size() const { return (sine_edges_.size() - 1) * (across_edges_rad_.size() - 1); }

  /// Rays that follow each other are neighbours (four rows at a time, from fore to aft), as packets want it.
  void fill(const random::Stream& jitter, std::uint64_t ping, Rays& rays) const;

 private:
  std::vector<double> sine_edges_;
  std::vector<double> across_edges_rad_;
};

}  // namespace ensonify::trace
