#pragma once

#include <vector>

/// Directions of a swath's beams: angles across track, positive to starboard, from the vertical when the receive
/// beams are roll-stabilised (stabilisation.h) and from the head's z axis when they are not.
///
/// Every function throws std::invalid_argument unless count >= 2 and -pi/2 < lower < upper < pi/2.
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

}  // namespace ensonify::array
