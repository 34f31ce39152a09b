#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "kernels/acoustics/array/pattern.h"
#include "kernels/acoustics/echo/arrival.h"

namespace ensonify::echo {

/// The sea surface as a mirror: flat, at a level. Between the head and it the water is taken as isovelocity.
struct SurfaceMirror {
  double level_enu_m = 0.0;         // z of the surface
  double sound_speed_mps = 1500.0;  // along the added paths
  double bounce_loss_db = 0.0;      // of each reflection, besides roughness: bubbles
  double rms_height_m = 0.0;        // of the waves: a coherent reflection has exp(-2 (k sigma sin(grazing))^2) left
};

/// Which paths to add.
struct MultipathParts {
  bool one_bounce = true;     // seabed - surface and surface - seabed
  bool second_bottom = true;  // seabed - surface - seabed, with one of the two seabed bounces a mirror's
  bool surface_echo = true;   // up and down again
};

/// Data of the head for the added paths. Poses are those of transmission; the receiver moves little in the
/// time of a bounce, and its attitude at arrival is used.
struct MultipathHead {
  double source_level_db = 220.0;            // on the transmit axis
  std::span<const array::Pattern> transmit;  // of all transducers that send at once
  double bottom_mirror_loss_db = 15.0;       // of a specular bounce off the seabed
};

/// All that make_echoes needs besides for echoes by way of the surface.
struct Multipath {
  MultipathHead head;
  SurfaceMirror surface;
  MultipathParts parts;
  double latest_s = std::numeric_limits<double>::infinity();  // echoes that come later may be left out
};

/// Memory of make_echoes: its contents do not matter.
struct EchoMemory {
  std::vector<std::array<std::size_t, 2>> images;  // by run of scatterers and way
};

/// Coherent amplitude of one reflection by the surface, with sign: what waves leave (kernels/acoustics) and bubbles let
/// through.
double surface_reflection(const SurfaceMirror& surface, double frequency_hz, double sin_grazing);

/// Arrivals that are one scatterer's by one way in both orders: for each of two ways, from `first` on, those of so many
/// scatterers in one order and then those in the other.
struct PairedArrivals {
  std::size_t first = 0;
  std::array<std::size_t, 2> scatterers{};  // of each way

  std::size_t pairs() const { return scatterers[0] + scatterers[1]; }
  std::size_t end() const { return first + 2 * pairs(); }
  struct Pair {
    std::size_t one, other;
  };
  Pair operator[](std::size_t pair) const {
    const bool second = pair >= scatterers[0];
    const std::size_t one = first + pair + (second ? scatterers[0] : 0);
    return {one, one + scatterers[second ? 1 : 0]};
  }
};

/// Mean over the beams of a line, at all sines, of the product of their amplitudes in two directions over that of a
/// square: the part that beams share of the cross term of two coherent waves. Exact for the sum of all beams.
struct SharedByBeams {
  array::PatternTable pattern;  // by the difference of the directions' sines
  Eigen::Vector3f axis_head;    // along which sines are counted

  float operator()(const Eigen::Vector3f& a, const Eigen::Vector3f& b) const {
    return pattern.amplitude(static_cast<double>((a - b).dot(axis_head))).real();
  }
};

/// Makes power gains, for Sum::kMeanSquare, of the amplitude gains of as many arrivals: squares, and for pairs also
/// what they have more because they add as pressures. With mean squares p and q and gains g and h that is
/// 2 s g h sqrt(p q), half of it with each. `shared`, s, is the part of it that one receiver has, of two directions:
/// 1 for an aperture (null), whose mean square becomes (g sqrt(p) + h sqrt(q))^2.
void power_gains(const Arrivals& arrivals, const PairedArrivals& paired, const SharedByBeams* shared,
                 std::span<float> gains);

/// Echoes by way of the surface, by images of the head; appended to `arrivals`, way by way and order by order, each in
/// the scatterers' order.
///
/// With z mirrored at the surface (the head's depth d, a scatterer's depth D), for each scatterer:
///   seabed - surface: out directly, back from the scatterer's image;
///   surface - seabed: out from the head's image, back directly. The two are of one length and carry the scatterer's
///     one response, so they add as pressures: 6.02 dB above one of them where the patterns are equal;
///   seabed - surface - seabed: one leg direct, the other from the head's image in the surface, mirrored again in the
///     level of the seabed below the head (depth of the bounce: the scatterer's own), with `bottom_mirror_loss_db`;
///     both orders.
/// And once, with the head's own image: the echo of the surface overhead, the coherent part only (its scattering is
/// that of rays traced to it).
/// Level: source level and transmit pattern in the direction of departure, scattering cross section (that of
/// backscattering at the hit), one over the squares of both straight legs, absorption along them, the surface's and the
/// bottom's reflections. Nothing is added for a head or a scatterer above the surface, nor for scatterers where waves
/// leave less than 1e-5 of the amplitude on every way to them (-100 dB: then it costs nothing). Returns which arrivals
/// are pairs: with Sum::kMeanSquare their gains need power_gains.
PairedArrivals add_multipath(const Carrier& carrier, const MultipathHead& head, const SurfaceMirror& surface,
                             const MultipathParts& parts, const frames::HeadPose& pose, const Scatterers& scatterers,
                             const Receivers& receivers, Arrivals& arrivals);

/// add_direct_echoes and then, if there is a surface, add_multipath, in place of what `arrivals` held. What both need
/// is computed once.
PairedArrivals make_echoes(const Carrier& carrier, const frames::HeadPose& pose, const Scatterers& scatterers,
                           const Receivers& receivers, const Multipath* multipath, EchoMemory& memory,
                           Arrivals& arrivals);

}  // namespace ensonify::echo
