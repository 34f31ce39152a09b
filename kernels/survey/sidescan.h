#pragma once

namespace ensonify::survey {

/// Coverage of one pass of a sidescan on level ground, to either side.
struct SidescanSwath {
  double near_m = 0.0;         // from the track to where the image begins: half the nadir gap
  double far_m = 0.0;          // to where it ends
  double far_grazing_rad = 0;  // at the far end
};

/// Seen from `altitude_m`, out to the slant range `range_m` > altitude, with a gap of `nadir_half_angle_rad` either
/// side of straight down: altitude tan(angle), and sqrt(range^2 - altitude^2).
SidescanSwath sidescan_swath(double altitude_m, double range_m, double nadir_half_angle_rad);

/// Distance of lines whose images join, leaving the nadir gaps: 2 far (1 - overlap).
double joining_spacing_m(const SidescanSwath& swath, double overlap);

/// Distance of lines at which each line's image also covers its neighbours' nadir gaps: far - near, less the overlap of
/// that: every place is seen at least once from either line, twice outside the gaps (200 % coverage).
double gap_filling_spacing_m(const SidescanSwath& swath, double overlap);

/// Altitude of a towfish for a range: a share of it, 10 to 20 % by common practice, but at least `least_m` above what
/// may stand up from the bottom, and low enough that the far end is not seen steeper than it must: the larger of the
/// two.
double towfish_altitude_m(double range_m, double share, double least_m);

/// Length of the shadow that an object throws: height range / (altitude - height), at the ground distance `range_m`.
/// Infinite where it is as high as the altitude.
double shadow_m(double object_m, double altitude_m, double ground_range_m);

}  // namespace ensonify::survey
