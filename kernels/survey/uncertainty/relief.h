#pragma once

#include <span>
#include <vector>

/// Relief inside footprints: a sounding gives the mean height over its footprint, not that of the point
/// that it claims. How far the two differ is judged by the soundings' own profile.
namespace ensonify::uncertainty {

/// One sounding of a ping's profile across the track.
struct ProfilePoint {
  double across_m = 0.0;     // level, any zero
  double height_m = 0.0;     // up
  double footprint_m = 0.0;  // half-power width of its beam on the seabed, > 0
  double noise_sd_m = 0.0;   // of the height, independent of its neighbours'
};

/// Squares of the fourth differences of the profile over one and two footprints to either side (joined by straight
/// lines), less what the noise adds to their mean, so that single values may be below 0. Slopes have none, and a flank
/// that is long against the footprint has little. NaN where the profile does not reach so far. `profile` ascends in
/// across_m; a point that does not is NaN and no neighbour.
std::vector<double> squared_bends_m2(std::span<const ProfilePoint> profile);

/// Variance of (mean height over a footprint less height at its middle) over that of the fourth difference of such
/// means, one footprint apart, on a seabed whose heights r apart differ by a variance proportional to r^(2 hurst),
/// 0 < hurst < 1, in any direction. It does not depend on how rough the seabed is. `aspect`: the footprint's width
/// along the track over that across, >= 0. Both ways it weighs as a beam's power over 1.5 half-power widths.
double unresolved_share(double hurst, double aspect);

}  // namespace ensonify::uncertainty
