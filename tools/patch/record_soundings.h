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

/// Leaves at most so many soundings, evenly; `accepted` is how many there were.
void thin(RecordInput& input, std::size_t most);

/// Throws UserError for a file that is no record, and for one without a single topic of soundings/1 or estimate/1 where
/// none is named; the text lists what there is.
RecordInput read_soundings(const std::filesystem::path& record, const Reading& reading);

}  // namespace ensonify::patch_tool
