#pragma once

#include <span>

#include "kernels/vehicle/runlines/runline.h"

/// Cost of a survey: where lines go, how fast, how long. Values in, values out.
namespace ensonify::survey {

/// The swath that a survey counts on.
struct Swath {
  double half_angle_rad = 1.0472;  // either side of nadir, 0 .. 80 degrees
  double overlap = 0.1;            // of the next line's near half swath with what is covered, 0 .. 0.9
};

/// Reach of the swath to one side of a head that is `depth_m` above the bottom below it, across the line. The
/// bottom is a plane that deepens by `deepening` per metre to that side (a tangent). Infinite where it falls away as
/// steeply as the beam. From x = tan(angle) (depth + deepening x).
double reach_m(double depth_m, double deepening, double half_angle_rad);

/// The end of what is covered on one row along the survey: how far across the survey it lies, and the depth below the
/// head there.
struct CoveredEdge {
  double across_m = 0.0;
  double depth_m = 0.0;
};

/// Place of the next line across the survey: as far from what is covered as its near half swath reaches, less the
/// overlap. Its outermost beam there hits the bottom at the edge, where the depth is known: the reach is
/// depth tan(angle), whatever the slope. The row that reaches least decides, so that no gap is left. A line that would
/// lie beyond the survey's far edge lies in the middle of what is left. Throws std::invalid_argument without a row.
double next_line_across_m(std::span<const CoveredEdge> rows, const Swath& swath, double far_edge_m);

/// Lines laid so, over their number when they are spaced for the shallowest depth, on a plane that deepens across the
/// survey from `shallow_m` to `deep_m`: the limit of narrow swaths, d1 ln(d2 / d1) / (d2 - d1). 1 on level ground.
/// Both > 0.
double adaptive_share(double shallow_m, double deep_m);

/// Pings a second of a head that waits for its farthest echo: 1 / (2 range / sound speed + dead time), not above
/// `highest_hz`. range_m > 0, dead_s >= 0.
double ping_rate_hz(double range_m, double sound_speed_mps, double dead_s, double highest_hz);

/// Length of a beam's footprint along the track straight below: 2 depth tan(width / 2).
double footprint_m(double depth_m, double along_width_rad);

/// Highest speed over ground at which a feature of a length along the track is hit by at least `pings` pings, wherever
/// they fall: (length + footprint) rate / pings, where a ping counts whose footprint touches the feature; with a
/// footprint of 0 only pings whose axis hits it count. pings >= 1.
double fastest_for_feature_mps(double feature_m, double footprint_m, double rate_hz, int pings);

/// Soundings across a feature of a width across the track, at least: of beams equally spaced over the bottom by
/// `beam_spacing_m`.
int soundings_across(double feature_m, double beam_spacing_m);

/// Parameters of running lines, and their costs.
struct RunRules {
  double speed_mps = 2.0;       // over ground on lines, > 0
  double turn_speed_mps = 2.0;  // > 0
  double turning_radius_m = 10.0;
  double run_in_m = 0.0;   // before each line, at its speed
  double run_out_m = 0.0;  // behind it
  double data_bytes_per_s = 0.0;
  bool record_in_turns = false;
  double cost_per_day = 0.0;  // any currency, of 24 h
};

struct RunCost {
  double line_m = 0.0;  // on lines alone
  double turn_m = 0.0;  // between them, by the shortest ways of the turning circle
  double line_s = 0.0;
  double turn_s = 0.0;  // with run-in and run-out
  double total_s = 0.0;
  double data_bytes = 0.0;
  double cost = 0.0;
};

/// Time, way and cost of lines run one after the other, the first from its run-in on.
RunCost run_cost(std::span<const runlines::Runline> lines, const RunRules& rules);

/// Redundancy of the coverage: swath of each line times its length, over the area. 1 is no place twice, where all is
/// covered.
double redundancy(std::span<const runlines::Runline> lines, std::span<const double> swath_m, double area_m2);

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
