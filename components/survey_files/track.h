#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/base/frames/pose.h"

namespace ensonify::survey_files {

/// Poses by time, in any order at first.
class Track {
 public:
  static constexpr std::int64_t kLongestGap_ns = 1'000'000'000;  // over which poses are not interpolated

  void add(std::int64_t unix_ns, const frames::Pose& pose) { poses_.push_back({unix_ns, pose}); }
  /// After the last add(): puts them in order. Of those at one time the first stays.
  void sort();

  bool empty() const { return poses_.empty(); }
  /// Interpolated. Nothing before the first and after the last, and within a long gap.
  std::optional<frames::Pose> at(std::int64_t unix_ns) const;
  /// And how it goes and turns, over 0.2 s: longer than the noise of attitudes, shorter than waves.
  std::optional<frames::MovingPose> moving_at(std::int64_t unix_ns) const;

 private:
  struct Entry {
    std::int64_t unix_ns;
    frames::Pose pose;
  };
  std::vector<Entry> poses_;
};

}  // namespace ensonify::survey_files
