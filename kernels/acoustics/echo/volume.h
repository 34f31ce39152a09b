#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "kernels/acoustics/echo/image.h"
#include "kernels/acoustics/echo/line_receiver.h"
#include "kernels/acoustics/echo/pulse.h"
#include "kernels/base/frames/pose.h"

namespace ensonify::echo {

/// Receive directions of a channel: a two-way power pattern as a few directions with solid angles.
///
/// Directions of the head's frame are cut along an axis (u, its direction cosine) and around it. The sum of the weights
/// is Psi = Integral b dOmega over the part; for volume scattering only that and the depth of each direction matter.
struct VolumeDirections {
  struct Direction {
    Eigen::Vector3f direction_head;  // about the middle of its part, weighted by the pattern
    float solid_angle_sr;            // Integral b dOmega over the part
  };
  std::vector<Direction> directions;

  /// The part of `power` with u in u_from..u_to along `axis_head`, from points `step_rad` apart (choose a tenth of
  /// the narrowest lobe), gathered in parts of some 3 degrees around the axis and as much along it. Parts below 1e-7
  /// of the largest are left out.
  static VolumeDirections of(const std::function<double(const Eigen::Vector3f& direction_head)>& power,
                             const Eigen::Vector3f& axis_head, double u_from, double u_to, double step_rad);
};

/// One entry per cell of a line receiver's sine grid: `power` is the transmit pattern times an element's; the array's
/// own pattern is the receiver's business. Cells stand for all their aliases.
std::vector<VolumeDirections> directions_of_cells(
    const LineReceiver& receiver, const std::function<double(const Eigen::Vector3f& direction_head)>& power,
    double step_rad);

/// The water's scatterers: backscattering cross section per volume and solid angle, 1/m (10^(Sv/10)), by depth below
/// the world's zero (positive down); 0 above the surface and below the seabed.
struct VolumeLayers {
  std::function<double(double depth_m)> backscatter_per_m;
  double deepest_m = 1000.0;  // nothing below; 0 or less: nothing, a seabed above the surface
  double step_m = 0.25;       // of the table that is made of it
};

/// Mean-square reverberation of every sample and channel (sample by channel; resized), uPa^2:
///
///   RL = SL - 20 log R - 2 alpha R + Sv + 10 log(Psi c tau / 2)   (kernels/acoustics),
///
/// with Sv at the depth of each direction, R = c t / 2 less half a pulse, and tau the pulse's equivalent length; 0
/// before the whole pulse has left. The head's pose is that of transmission. What lies beyond the seabed is left out by
/// VolumeLayers only.
void reverberation_upa2(double source_level_db, double absorption_dbpm, double sound_speed_mps,
                        std::span<const VolumeDirections> channels, const VolumeLayers& layers,
                        const frames::HeadPose& pose, const Pulse& pulse, const Sampling& sampling,
                        std::vector<float>& mean_square_upa2);

}  // namespace ensonify::echo
