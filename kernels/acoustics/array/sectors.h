#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "kernels/acoustics/array/line_array.h"

/// Transmit sectors: parts of a swath that are ensonified one after another or at different frequencies.
namespace ensonify::array {

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
