#pragma once

/// How much of white noise on the nodes of a spline surface (spline.h) is left on the surface.
namespace ensonify::relief {

/// Mean over the posts of the variance that white noise of unit variance at the nodes `levels_down` levels above the
/// posts gives the surface there. 0.3965^2 for 0, towards 0.3939^2, the integral of b^2 squared.
double variance_at_posts(int levels_down);

/// The same for the coefficients themselves after `levels_down` refinements: 1 for 0, towards the same limit.
double variance_of_coefficients(int levels_down);

}  // namespace ensonify::relief
