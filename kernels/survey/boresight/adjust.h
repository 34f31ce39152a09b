#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "kernels/base/frames/attitude.h"

/// Patch test: how a multibeam echo sounder is turned on its vehicle, and how late its navigation is, found from
/// soundings of the same seabed on several lines.
namespace ensonify::boresight {

using frames::Quaternion;
using frames::Vec3;

/// A sounding as the instrument placed it, and what it was placed by: the navigation estimate at transmission. All in
/// the world (ENU).
struct Sounding {
  double time_s = 0.0;
  Vec3 place_enu_m = Vec3::Zero();
  Vec3 head_enu_m = Vec3::Zero();  // the head at transmission
  Quaternion enu_from_body = frames::enu_from_ned();
  Vec3 velocity_enu_mps = Vec3::Zero();  // of the head
  Vec3 rate_enu_radps = Vec3::Zero();    // of the body's turning
};

/// Errors of the installation. Zero: none.
struct Offsets {
  double position_latency_s = 0.0;  // age of east and north at their stamp: the vehicle was further on by v times this
  double attitude_latency_s = 0.0;  // age of an attitude and of heave at their stamp
  double roll_rad = 0.0;            // actual minus measured mounting: starboard down,
  double pitch_rad = 0.0;           // bow up,
  double yaw_rad = 0.0;             // clockwise from above, as rotations about the vehicle's axes
};

/// Place of the sounding if the offsets are as given: moved on along the track and with heave, and turned about the
/// head as one piece, by the vehicle's turning during the latency and by yaw, pitch and roll of the mounting. The
/// head's own way when the mounting turns (lever arms) is not touched, nor is the ray bent anew: where sound is 10 m/s
/// faster 30 m below, 1 degree at a beam of 60 degrees so misplaces by 6 mm, 3.5 degrees by 22 mm (closed form of the
/// arc); after a large offset, survey again with the mounting corrected.
struct Placed {
  Vec3 place_enu_m;
  Eigen::Matrix<double, 3, 5>
      rates;  // m per s of the latencies, m per rad of roll, pitch, yaw: in the order of Offsets
};
Placed place(const Sounding& sounding, const Offsets& offsets);

/// Soundings of one run along a line, in order of time, and how far the navigation may wander meanwhile (standard
/// deviations, each axis).
struct Line {
  std::vector<Sounding> soundings;
  Vec3 position_sd_m = Vec3::Zero();    // east, north, up: of satellite positions, and of tide and heave
  Vec3 rotation_sd_rad = Vec3::Zero();  // of roll, pitch, heading
};

/// The unknowns in the order of vectors and matrices.
inline constexpr std::size_t kUnknowns = 5;
inline constexpr std::array<const char*, kUnknowns> kUnknownNames = {"position_latency", "attitude_latency", "roll",
                                                                     "pitch", "yaw"};
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
Offsets offsets_of(const Unknowns& unknowns);
Unknowns unknowns_of(const Offsets& offsets);

struct AdjustSettings {
  double cell_m = 3.0;           // side of the squares in which lines are compared
  int layings = 2;               // of the squares, each way: shifted by cell_m / layings east, north and both
  std::size_t least = 5;         // soundings of a line in a cell
  double piece_s = 10.0;         // pieces of a line, each of which may be shifted and turned
  double height_piece_s = 1.0;   // the same for heights
  double wander_s = 60.0;        // correlation time of those shifts (Gauss-Markov), of positions
  double turn_wander_s = 600.0;  // and of attitudes: what lasts all through a survey appears as the mounting
  double together_s = 0.1;       // soundings of a line within such a stretch of time may err together: a ping
  double angle_sd_rad = 7e-5;    // all angles across may be off together (0.004 degrees): appears as roll
  double gate_sds = 4.0;         // soundings further off their cell's plane are left out
  std::array<bool, kUnknowns> solve = {true, true, true, true, true};  // the others stay zero
  int most_rounds = 30;
};

struct Adjusted {
  Offsets offsets;
  Unknowns sd = Unknowns::Zero();       // standard deviations; zero of what was not solved for
  Unknowns half_95 = Unknowns::Zero();  // half widths of the 95 % intervals: 1.96 sd where many stretches of time
                                        // contribute, more where few do (a rock is passed in seconds)
  double rms_before_m = 0.0;            // about the cells' planes
  double rms_after_m = 0.0;
  std::size_t cells = 0;      // of the first laying
  std::size_t soundings = 0;  // used in it
  int rounds = 0;             // of it
  bool converged = false;     // all layings
};

/// Least-squares adjustment of all unknowns at once [Bjorke2005], on planes through the soundings of each cell
/// [SeubeKeyetieu2017]; the attitude's latency shows in the same way [Milac2018]. Each piece of a line may besides
/// be shifted and turned by what its navigation may be off, weighted by the stated deviations as a Gauss-Markov
/// process that goes on from line to line. The intervals contain what that process does to the estimate, as it is and
/// not in pieces, and what soundings of unequal quality [White1980] have in common within a stretch of time
/// [LiangZeger1986], by what they are off the planes that are laid without them [MacKinnonWhite1985,
/// BellMcCaffrey2002]. The stated deviations are taken to be right to a tenth [GUM2008, G.4.2].
///
/// How the squares lie beside the pings changes the answer, so it is done for several layings of them, and the answer
/// is their mean; the intervals hold how they differ (mean_of).
///
/// What the lines do not state comes out with a wide deviation. Throws std::invalid_argument for
/// fewer than two lines, settings that are not positive, places that are not finite, and when no cell has two lines.
Adjusted adjust(const std::vector<Line>& lines, const AdjustSettings& settings);

/// Variances of the unknowns, and by how many degrees of freedom each is known [Satterthwaite1946].
struct Spread {
  Unknowns variance = Unknowns::Zero(), freedom = Unknowns::Zero();
};

/// Mean of several layings of the squares over the same soundings, each with its spread. Its
/// variance is that within a laying, in the mean, and (1 + 1/m) times that between them [Rubin1987, ch. 3]. That is too
/// much rather than too little: a mean of m errs less than one laying, as far as layings differ.
struct Found {
  Unknowns unknowns = Unknowns::Zero();
  Spread spread;
};
Found mean_of(const std::vector<Found>& layings);

/// Half widths of the 95 % intervals: Student's t, by Cornish and Fisher's series in 1 / freedom (to 1 % from 3 on,
/// below that as for 3) [Abramowitz1964].
Unknowns half_95(const Spread& spread);

}  // namespace ensonify::boresight
