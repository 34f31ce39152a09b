#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kernels/acoustics/array/line.h"

/// Directions of a swath's beams, and transmit sectors: parts of a swath that are ensonified one after another or at
/// different frequencies. Beams are angles across track, positive to starboard, from the vertical when the receive
/// beams are roll-stabilised (stabilisation.h) and from the head's z axis when they are not.
///
/// Every layout throws std::invalid_argument unless count >= 2 and -pi/2 < lower < upper < pi/2.
namespace ensonify::array {

/// `count` angles from lower to upper, equally spaced in angle.
std::vector<float> equiangular_beams_rad(double lower_rad, double upper_rad, int count);

/// Angles whose axes are equally spaced on a level seabed (in the tangent).
std::vector<float> equidistant_beams_rad(double lower_rad, double upper_rad, int count);

/// Beams of a swath that reaches equally far to both sides.
inline std::vector<float> equiangular_beams_rad(double half_swath_rad, int count) {
  return equiangular_beams_rad(-half_swath_rad, half_swath_rad, count);
}
inline std::vector<float> equidistant_beams_rad(double half_swath_rad, int count) {
  return equidistant_beams_rad(-half_swath_rad, half_swath_rad, count);
}

/// More soundings than beams. Outer beams of a swath cover several equal steps on the seabed, and phase detection can
/// place a sounding anywhere inside a beam. So beams are formed equally spaced in angle, soundings are sought equally
/// spaced on a level seabed, and each is taken from the beam whose axis is nearest in sine. Near the nadir,
/// where steps are wider than beams, some beams give no sounding.
struct HighDensity {
  std::vector<float> beam_rad;
  std::vector<float> sounding_rad;
  std::vector<int> beam_of_sounding;  // index in beam_rad, ascending
};

/// Also throws when there are fewer soundings than beams.
HighDensity high_density_beams(double lower_rad, double upper_rad, int beams, int soundings);

/// Angles are counted across track from the vertical when stabilised in roll, else from the head's z axis, positive to
/// starboard.
struct TransmitSector {
  double centre_rad = 0.0;
  double width_rad = 0.0;      // between the edges, where the transmitted amplitude is one half (-6 dB)
  double tilt_rad = 0.0;       // of the fan, forward of the y-z plane
  double frequency_hz = 0.0;   // of the carrier
  double delay_s = 0.0;        // of its transmission after the ping's first
  double focus_range_m = 0.0;  // of the line along x; 0: focusing off

  double lower_rad() const { return centre_rad - 0.5 * width_rad; }
  double upper_rad() const { return centre_rad + 0.5 * width_rad; }
};

/// The sector in which a direction is nearest to the centre, in half widths: where sectors overlap the one that
/// receives it better, on a common edge the first. Nothing outside all of them.
std::optional<std::size_t> sector_of(std::span<const TransmitSector> sectors, double across_rad);

/// The across-track beam of a sector: a flat top with steep edges.
///
/// The weights are the Fourier coefficients of a rectangle from edge to edge times a Hamming window, as for a
/// finite-impulse-response filter designed with that window [Harris1978], so the pattern is the rectangle convolved
/// with the Hamming array's. In amplitude: 1 within 0.04 dB inside, one half at the edges, below -50 dB beyond, with a
/// transition `roll_off_sine` wide that is centred on each edge. The aperture has to be 3.5 lambda / roll_off long.
struct SectorBeam {
  LineArray array;         // across track; half a wavelength from element to element
  double sin_steer = 0.0;  // the middle between both edges
};

/// Edges are sines in the head's frame (across_sine of the sector's edges: roll-stabilised ones move in it), ascending;
/// an edge beyond -1..1 is allowed and never reached. Throws std::invalid_argument unless 0.01 <= roll_off_sine <=
/// upper - lower: a sector cannot be narrower than its roll-off, and needs no more than some 700 elements.
SectorBeam sector_beam(double wavelength_m, double lower_sine, double upper_sine, double roll_off_sine = 0.2);

}  // namespace ensonify::array
