#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/frames/pose.h"
#include "kernels/random/stream.h"
#include "kernels/trace/ray.h"
#include "kernels/trace/scene.h"

namespace ensonify::trace {

/// One of the two coordinates of a direction, and what the head does along it.
struct Span {
  double low = 0.0, high = 0.0;            // rays go from here to there
  double main_low = 0.0, main_high = 0.0;  // the main lobe, null to null: full density; less beyond, as 1 / distance^2
  double beam = 0.0;                       // -3 dB width of what beams resolve, or of the lobe where nothing does
};

/// Where a head transmits, in its own frame: u is the sine of the angle from the plane across an axis of the head, phi
/// the angle around that axis, towards starboard. Then dOmega = du dphi exactly.
struct TransmitVolume {
  enum class Axis {
    kForward,  // phi = 0 looks down: across-track angle of a multibeam or a sidescan (phi < 0 is to port)
    kDown      // phi = 0 looks forward: azimuth of a forward-looking or scanning head; u is the sine of the depression
  };
  Axis axis = Axis::kForward;
  Span sine;       // u, within -1..1
  Span angle_rad;  // phi, at most a full circle
};

/// Narrow along-track, wide across-track: transmit and receive lines L / lambda waves long, and rays to
/// `reach` lambda / L fore and aft (1 is the first null). half_swath_rad is to port and starboard.
TransmitVolume mills_cross_volume(double transmit_length_in_waves, double receive_length_in_waves,
                                  double half_swath_rad, double reach = 8.0);

struct RaySettings {
  /// In the main lobe, a resolution cell (range resolution x beam, -3 dB) gets 12 rays times this on average and a
  /// facet
  /// 10. At kNormal every cell within -10 dB has at least 10, and of 1000 facets in the main lobe 999 are hit; kPreview
  /// is for a quick look and kReference to compare with.
  double quality = kNormal;
  double range_resolution_m = 0.1;    // c tau / 2, or c / 2B of a chirp
  std::size_t most_rays = 2'000'000;  // per transmission: every cell gives way by the same share beyond
  std::size_t fewest_rays = 0;        // at normal quality, else that times the quality: cells share in what is missing

  static constexpr double kPreview = 0.25, kNormal = 1.0, kReference = 4.0;
};

/// Rays over a transmit volume, denser where the seabed asks for it.
///
/// The volume is cut into some thousand cells of direction. One probe ray to each corner tells how far away and how
/// wide apart the seabed is that a cell sees; from that follows how many rays the cell needs, so that each resolution
/// cell (range resolution x beam) and each facet that it sees gets the number that the quality asks for. The cell is
/// then cut into as many equal strata, with one ray at a random place in each, which depends on (stream, cell, stratum)
/// only: the rays are an unbiased sample of the volume whatever the density, and the same pose over the same tiles has
/// the same rays. Where neighbouring corners see different things (the edge of a boulder, the end of a shadow) they are
/// far apart and the cell gets many rays; at grazing incidence likewise.
///
/// The number of rays grows with what is seen, about rays per cell x (resolution cells or facets, whichever are more)
/// in the main lobe, and a third more beyond it; not with the number of beams. A corner that meets nothing counts as
/// lying on the plane of the farthest facet that its cell sees, and no farther than the range. A cell that sees nothing
/// has one ray. A Mills cross of 1 degree x 130 degrees has cells of 1.3 degrees across-track: a thing that is smaller,
/// and missed by the probes, gets the rays that the seabed around it asks for.
class RayDistribution {
 public:
  /// Throws std::invalid_argument for empty or overlapping spans, and for settings that are not positive.
  RayDistribution(const TransmitVolume& volume, const RaySettings& settings, const random::Stream& stream);

  /// Turns the volume from now on: to a sine, as phase shifts along the axis do, and by an angle about the axis.
  /// Neither changes solid angles; sines beyond -1 and 1 are lost. (0, 0) is the volume as given.
  void steer(double sine, double angle_rad);

  /// The rays that look first; their solid angles are 0. They change with steer().
  std::span<const Ray> probes() const { return probes_; }

  /// The rays for what the probes met within max_range_m. Neighbours follow each other, as packets want it. Throws
  /// std::invalid_argument unless there is one hit per probe.
  void fill(const frames::HeadPose& head, std::span<const Hit> probe_hits, float max_range_m, std::vector<Ray>& rays);

  /// What the last fill had of the rays that the quality asks for: 1; less where most_rays limits them, more where
  /// there are fewest_rays.
  double share() const { return share_; }

 private:
  struct Cell {
    std::uint32_t along_sine = 1, along_angle = 1;  // strata
    std::size_t first = 0;                          // ray
  };
  struct Need {
    double rays, sine_to_angle;  // strata, and their number along u over that along phi
  };
  struct Look {
    const frames::HeadPose& head;
    std::span<const Hit> hits;
    double max_range_m;
  };
  struct Corners;
  std::size_t corner(std::size_t i, std::size_t j) const { return i * angle_edges_rad_.size() + j; }
  void aim();
  bool look(std::size_t i, std::size_t j, const Look& probes, Corners& corners) const;
  Need need(std::size_t i, std::size_t j, const Look& probes) const;
  std::size_t cut(double share);
  void fill_cell(std::size_t index, std::span<Ray> rays) const;

  TransmitVolume volume_;
  RaySettings settings_;
  random::Stream stream_;
  double steered_sine_ = 0.0, steered_rad_ = 0.0;
  std::vector<double> volume_sines_, volume_angles_rad_;  // edges of the cells, as given ...
  std::vector<double> sine_edges_, angle_edges_rad_;      // ... and as steered
  std::vector<Ray> probes_;
  std::vector<Need> needs_;
  std::vector<Cell> cells_;
  double share_ = 1.0;
};

}  // namespace ensonify::trace
