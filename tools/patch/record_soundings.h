#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kernels/boresight/adjust.h"

namespace ensonify::patch_tool {

struct Reading {
  std::string soundings;         // topic; "": the only one of that type
  std::string estimate;          // likewise
  std::size_t most = 1'000'000;  // soundings kept, thinned evenly
};

/// What a record holds for a patch test: nothing but what instruments said.
struct Heard {
  std::string soundings_topic, estimate_topic;
  std::vector<boresight::Sounding> soundings;           // accepted ones, in order of time
  std::size_t accepted = 0;                             // before thinning
  frames::Vec3 position_sd_m = frames::Vec3::Zero();    // that the estimate states, root mean square; zero: not told
  frames::Vec3 rotation_sd_rad = frames::Vec3::Zero();  // roll, pitch, heading
};

/// Throws UserError for a file that is no record, and for one without a single topic of soundings/1 or estimate/1 where
/// none is named; the text lists what there is.
Heard read_soundings(const std::filesystem::path& record, const Reading& reading);

}  // namespace ensonify::patch_tool
