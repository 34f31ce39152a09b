#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kernels/survey/boresight/adjust.h"

namespace ensonify::patch_tool {

struct Reading {
  std::string soundings;         // topic; "": the only one of that type
  std::string estimate;          // likewise
  std::size_t most = 1'000'000;  // soundings kept, thinned evenly
};

/// Errors that the estimate states. Zero: none stated.
struct Stated {
  double time_s = 0.0;
  frames::Vec3 position_variance_m2 = frames::Vec3::Zero();    // east, north, up
  frames::Vec3 rotation_variance_rad2 = frames::Vec3::Zero();  // roll, pitch, heading
};

/// The mean of what is stated between two times; zero where nothing is.
Stated mean_stated(const std::vector<Stated>& stated, double from_s, double to_s);

/// Input of a patch test from a record: reports of instruments alone.
struct RecordInput {
  std::string soundings_topic, estimate_topic;
  std::vector<boresight::Sounding> soundings;  // accepted ones, in order of time
  std::size_t accepted = 0;                    // before thinning
  std::vector<Stated> stated;                  // by each estimate, in order of time
};

/// Throws UserError for a file that is no record, and for one without a single topic of soundings/1 or estimate/1 where
/// none is named; the text lists what there is.
RecordInput read_soundings(const std::filesystem::path& record, const Reading& reading);

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
