#pragma once

#include <vector>

#include "kernels/seabed/statistics/surface.h"

namespace ensonify::relief {

/// A relief spectrum: a power law between an outer and an inner scale, isotropic.
///
///   W(K) proportional to K^-(2 H + 2) for 2 pi / outer << K << 2 pi / inner,
/// level below the first ([vonKarman1948]'s form, (K^2 + Ko^2)^-(H+1)) and falling as exp(-K inner / 2 pi) beyond the
/// second. The exponent gamma = 2 H + 2 is that of [APL1994]; its sediments have gamma 3.25, H = 0.625.
struct Spectrum {
  double rms_m = 0.0;          // of the height, over a domain of many outer scales
  double hurst = 0.625;        // 0 < H <= 1
  double outer_scale_m = 1.0;  // 2 pi / Ko, > 0
  double inner_scale_m = 0.0;  // 2 pi / Ki, >= 0; 0: down to the posts and below
};

/// Throws std::invalid_argument with the cause when the numbers are out of their ranges.
void check(const Spectrum& spectrum);

/// W at the wave number K, rad/m, in m^4: its integral over the plane of wave numbers is rms^2.
double density_m4(const Spectrum& spectrum, double wave_number_radpm);

/// Mean of (z(a) - z(b))^2 over pairs of places `distance_m` apart, m^2.
double structure_m2(const Spectrum& spectrum, double distance_m);

/// Mean square slope (of the gradient: both directions together) of the triangles between posts of such a surface that
/// stand this far apart, two triangles to a cell: 2 D(spacing) / spacing^2, since each is known by a difference along
/// either axis.
double facet_mean_square_slope(const Spectrum& spectrum, double post_spacing_m);

/// Spectral strength w2 of the power law, W = w2 K^-gamma, in SI units (m^(4 - gamma); [APL1994]'s w2 in cm^4 times
/// 10^(2 gamma - 8)), and the rms that a strength asks for.
double strength(const Spectrum& spectrum);
double rms_of_strength_m(double strength_si, double hurst, double outer_scale_m);

/// Shares of the variance among splines of white noise, one per level of the lattice.
///
/// W is an integral of Gaussians exp(-K^2 t) with weights t^H exp(-t Ko^2 - 1 / (4 Ki^2 t)) d ln t; their correlations
/// are exp(-r^2 / 4 t). That of a quintic spline with nodes h apart, a B-spline of degree 11, is close to it for
/// t = 0.525 h^2 (0.526 by its curvature at 0, 0.5 by its width). So the level with that t takes the weight of its
/// octave: the trapezoidal rule in ln t, whose error is a ripple of 2 (H = 0.3) to 4 % (H = 1) of W.
struct Octaves {
  std::vector<double> variance_m2;  // of level 0, 1, ... : splines
  double below_posts_m2 = 0.0;      // all finer levels together, as white noise at the posts; of each what differs
                                    // between neighbours, so that D(one post) is right
};
Octaves octaves_of(const Spectrum& spectrum, double post_spacing_m);

/// The detail that a guide of coarse cells lacks, as a spectrum to add to its smooth surface.
///
/// The guide's own spectrum is trusted up to 0.7 of its Nyquist wave number; from there on the relief goes on with the
/// exponent 2 H + 2 and the strength it has there (mean of ln(W K^gamma) over 0.5 to 0.9 Nyquist's). Below, the outer
/// scale of two waves at Nyquist's lets the added relief end where the guide's begins. Six measured sites, thinned and
/// rebuilt so, were matched within 1.3 dB on four with H = 0.625; going on with the guide's own slope was wrong by up
/// to 12 dB.
///
/// Empty where the guide has no whole window of 16 cells. A survey product is often smooth below 6 to 8 of its cells:
/// then `band_start_cells` says where its spectrum is still valid (2: at Nyquist's wave length).
struct Detail {
  Spectrum spectrum;         // rms 0 if there is nothing to go on
  double strength_si = 0.0;  // W = strength K^-(2 H + 2)
};
Detail detail_below(const relief_statistics::Surface& guide, double hurst = 0.625, double band_start_cells = 2.0);

}  // namespace ensonify::relief
