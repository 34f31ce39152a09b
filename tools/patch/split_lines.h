#pragma once

#include <vector>

#include "kernels/survey/boresight/adjust.h"

namespace ensonify::patch_tool {

/// A straight run that the vehicle made.
struct RunLine {
  double from_s = 0.0, to_s = 0.0;  // sim time of the first and last ping
  double heading_rad = 0.0;         // grid, mean
  double speed_mps = 0.0;           // over the ground, mean
  boresight::Line line;
};

/// The straight runs among soundings in order of time: as long as the heading stays within 10 degrees of the run's mean
/// and pings follow each other within 5 s; runs shorter than 20 s are turns, and left out. Deviations of the navigation
/// are left zero.
std::vector<RunLine> split_lines(const std::vector<boresight::Sounding>& soundings);

}  // namespace ensonify::patch_tool
