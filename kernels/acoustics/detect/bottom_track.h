#pragma once

#include <span>
#include <vector>

/// Bottom track of a sidescan or an echosounder: the first strong echo of its own waterfall that
/// lasts, and with it the ground range of the rest on a flat bottom. Never the true altitude.
namespace ensonify::detect {

/// One line of a waterfall, linear amplitude (before any gain that grows with range): sample k is at the slant range
/// first_range_m + k * range_step_m.
struct WaterfallLine {
  std::span<const float> amplitude;
  double first_range_m = 0.0;
  double range_step_m = 0.05;
};

struct FirstBottomSettings {
  double blanking_m = 1.0;     // transmission, and the body that carries the head
  double threshold_db = 12.0;  // a sample is strong if this far above the water column before it
  double column_m = 1.0;       // of water column needed to judge by, after the blanking
  double echo_m = 0.0;         // of range, that the echo of a single point fills: half the pulse behind the filter
  double persistence_m = 1.0;  // the bottom keeps answering for so long; fish do not
  double share = 0.7;          // of the samples in it that must be strong; more of them than a single echo fills
  double follow_m = 1.5;       // how far from the last pick the bottom is sought, while it is tracked
  int patience = 5;            // lines without a pick before it is sought everywhere again
};

struct BottomPick {
  bool found = false;
  double altitude_m = 0.0;  // slant range of the first bottom: the altitude over a flat one
};

/// The first range between nearest_m and farthest_m from which on `share` of the samples within persistence_m are
/// strong and which is strong itself. Where a single echo could fill that share, the samples are as many more as it
/// takes that it cannot, with a tenth to spare: nothing that is received for one pulse is the bottom, be it a fish or
/// the surface overhead. A bottom that answers for less than 1.1 pulses and a sample is not found either. The water
/// column is the geometric mean power of all samples between blanking and there, so that a few strong ones count little
/// (for noise it reads 2.5 dB below the mean).
///
/// False picks: noise is strong with probability p = exp(-10^((threshold - 2.5 dB) / 10)), 1.5e-4 at 12 dB. Behind the
/// receiver's filter samples within a pulse are alike, so pulses count: 1.1 of them hold two independent samples, p^2,
/// and of n pulses of persistence 0.7 n must be strong, below 1e-20 for n = 10.
BottomPick first_bottom(const FirstBottomSettings& settings, const WaterfallLine& line, double nearest_m = 0.0,
                        double farthest_m = 1e9);

/// The bottom from line to line.
struct BottomTrack {
  bool tracked = false;
  double altitude_m = 0.0;  // the last pick; 0 before the first
  int missed = 0;           // lines since
};

/// The track after one more line: near the last pick while tracked, and kept there for `patience` lines without one.
BottomTrack follow(const FirstBottomSettings& settings, const BottomTrack& before, const WaterfallLine& line);

}  // namespace ensonify::detect
