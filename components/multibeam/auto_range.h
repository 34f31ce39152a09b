#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace ensonify {

/// Chooses how long to listen from what was detected last, as an operator would: a little farther than the farthest
/// detections, in steps. With hardly any detection it falls back to the longest range.
class AutoRange {
 public:
  explicit AutoRange(double longest_m) : longest_m_(longest_m), range_m_(longest_m) {}

  double range_m() const { return range_m_; }

  /// Slant ranges of the soundings of a ping that listened to `listened_m`, in any order, and how many beams there are.
  void update(std::vector<double>& ranges_m, std::size_t beams, double listened_m) {
    if (ranges_m.size() < kFewest * static_cast<double>(beams)) {
      range_m_ = longest_m_;
      return;
    }
    // A few outliers must not rule: the farthest but 2 %.
    const auto rank = static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(ranges_m.size() - 1));
    std::nth_element(ranges_m.begin(), ranges_m.begin() + rank, ranges_m.end());
    double wanted = kMargin * ranges_m[static_cast<std::size_t>(rank)];
    // Beams without detection at the swath's edges may look beyond what was listened to.
    if (ranges_m.size() < kMost * static_cast<double>(beams)) wanted = std::max(wanted, kGrow * listened_m);
    range_m_ = std::clamp(std::ceil(wanted / kStep_m) * kStep_m, std::min(kStep_m, longest_m_), longest_m_);
  }

 private:
  static constexpr double kFewest = 0.1;  // share of beams with a detection
  static constexpr double kMost = 0.97;
  static constexpr double kMargin = 1.1;
  static constexpr double kGrow = 1.1;
  static constexpr double kStep_m = 1.0;

  double longest_m_;
  double range_m_;
};

}  // namespace ensonify
