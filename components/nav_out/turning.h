#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

#include "kernels/base/frames/attitude.h"

namespace ensonify::nav_out {

/// The rate of turn by headings: their change over the last second, to starboard.
class Turning {
 public:
  void take(std::int64_t stamp_ns, double heading_rad) {
    headings_.emplace_back(stamp_ns, heading_rad);
    while (headings_.size() > 2 && headings_[1].first <= stamp_ns - kOver_ns) headings_.pop_front();
  }

  /// Nothing before there are headings of half a second.
  std::optional<double> rate_radps() const {
    if (headings_.empty()) return std::nullopt;
    const std::int64_t over_ns = headings_.back().first - headings_.front().first;
    if (over_ns < kOver_ns / 2) return std::nullopt;
    return frames::wrap_pi(headings_.back().second - headings_.front().second) / (1e-9 * static_cast<double>(over_ns));
  }

 private:
  static constexpr std::int64_t kOver_ns = 1'000'000'000;
  std::deque<std::pair<std::int64_t, double>> headings_;
};

}  // namespace ensonify::nav_out
