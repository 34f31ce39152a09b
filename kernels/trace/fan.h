#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/frames/attitude.h"
#include "kernels/random/stream.h"
#include "kernels/trace/ray.h"

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

/// Rays over the transmit volume of a Mills cross.
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
  void fill(const random::Stream& jitter, std::uint64_t ping, std::vector<Ray>& rays) const;

 private:
  std::vector<double> sine_edges_;
  std::vector<double> across_edges_rad_;
};

/// What line arrays along the head's x axis transmit into, to both sides: from one angle about that axis to another,
/// as far as above the horizon.
struct SideFanShape {
  double transmit_length_in_waves = 200.0;  // L / lambda of the lines
  double along_reach = 8.0;                 // as of FanShape
  double from_rad = -1.75;                  // of the head's z axis, negative to port, more than -pi ...
  double to_rad = 1.75;                     // ... to less than pi
  int along = 24;
  int across = 4096;  // rows
  int look = 1024;    // directions of the first look
  double range_share =
      0.7;  // share of the rows spread equally in the slant range of what the first look met; the rest in angle
};

/// A fan whose rows follow the seabed: a first look, one ray in the middle of each of `look` equal angles, tells where
/// slant range changes fast with angle (at grazing incidence) and where nothing is met. Rows are laid accordingly, so
/// that a stretch of slant range gets its rays wherever it lies. Directions without an answer get a twentieth of the
/// rows of others, in case something stands between two looks.
///
/// Strata, jitter and solid angles are those of Fan: any choice of rows is unbiased.
class SideFan {
 public:
  /// Throws std::invalid_argument for a shape without rays or angles in the wrong order.
  explicit SideFan(const SideFanShape& shape);

  std::size_t size() const { return (sine_edges_.size() - 1) * static_cast<std::size_t>(shape_.across); }

  /// The rays to look with, in order of angle.
  std::span<const Ray> look() const { return look_; }

  /// The rays for what the look met (slant range by ray; 0: nothing).
  void fill(std::span<const float> met_range_m, const random::Stream& jitter, std::uint64_t ping,
            std::vector<Ray>& rays);

 private:
  void lay_rows(std::span<const float> met_range_m);

  SideFanShape shape_;
  std::vector<double> sine_edges_;
  std::vector<Ray> look_;
  std::vector<double> extent_m_, rows_;  // by look: slant range that it stands for, rows that it gets
  std::vector<double> across_edges_rad_;
};

}  // namespace ensonify::trace
