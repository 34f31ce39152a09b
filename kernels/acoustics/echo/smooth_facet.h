#pragma once

#include <array>
#include <complex>

#include "kernels/base/frames/attitude.h"
#include "kernels/mesh/solids/facet.h"

/// Echoes of rigid bodies whose surface is smooth: no random phase, what parts of them send adds as pressure.
namespace ensonify::echo {

/// Integral of exp(j per_m . (x - middle)) over a triangle, m^2; middle: the mean of its corners. Closed form (a
/// divided difference of the exponential), exact to 1e-9 of the triangle's area.
std::complex<double> phase_integral_m2(const solids::Corners& triangle, const frames::Vec3& per_m);

/// What a smooth rigid facet sends back to where it is insonified from, as a length: echo pressure at 1 m over that
/// which arrives, phase from the facet's middle. Its square is the backscattering cross section; 10 log10 of that is a
/// target strength, dB re 1 m^2.
///
/// Kirchhoff's approximation: f = (j k / 2 pi) integral of (n . r) exp(2 j k r . x) dS over what is lit, r towards the
/// head, with exp(-2 j k R) for the way [Medwin1998]. The sphere of radius a has a / 2 by it, a plate of area A that is
/// met square A / lambda. Right where the surface bends little within a wavelength; no edge waves, nothing that creeps
/// round, no resonance. 0 for a facet that faces away, unless it is one of two sides. The wave is plane across the
/// facet: keep its sides below longest_side_m(). A curved one is taken as kCurvedParts^2 flat ones: with sagittas of a
/// sixteenth of the wave a sphere has its level within 0.1 dB from everywhere; with flat facets alone it would be 3 dB
/// off.
std::complex<double> facet_amplitude_m(const solids::Facet& facet, const frames::Vec3& towards_head,
                                       double wavenumber_radpm, bool two_sided = false);

/// Longest side of a facet for which the wave is plane: a quarter of the Fresnel zone, sqrt(lambda R) / 4. The phase
/// is off by at most 0.1 rad at its corners.
double longest_side_m(double wavelength_m, double range_m);

/// A body's triangles must not lie farther from its surface than this: a sixteenth of a wavelength.
constexpr double kSagittaInWaves = 1.0 / 16.0;
constexpr int kCurvedParts = 6;  // of an edge of a curved facet

}  // namespace ensonify::echo
