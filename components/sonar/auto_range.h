#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace ensonify {

/// Bottom return of a beam.
struct BottomDetection {
  double beam_angle_rad = 0.0;
  double range_m = 0.0;
};

/// Chooses how long to receive from what was detected last, as an operator would: a little farther than the edge of the
/// swath, in steps. With hardly any detection it falls back to the longest range.
class AutoRange {
 public:
  AutoRange(double longest_m, double half_swath_rad, int beams)
      : longest_m_(longest_m), half_swath_rad_(half_swath_rad), beams_(beams), range_m_(longest_m) {}

  double range_m() const { return range_m_; }

  /// The detections of a ping that received `received_range_m`.
  void update(std::span<const BottomDetection> detected, double received_range_m) {
    if (static_cast<double>(detected.size()) < kFewest * beams_) {
      range_m_ = longest_m_;
      return;
    }
    edges_m_.clear();
    for (const BottomDetection& h : detected) edges_m_.push_back(edge_range_m(h));
    // A lone outlier must not rule: the farthest but 1 %.
    const auto rank = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(edges_m_.size() - 1));
    std::nth_element(edges_m_.begin(), edges_m_.begin() + rank, edges_m_.end());
    double wanted_m = kMargin * edges_m_[static_cast<std::size_t>(rank)];
    if (static_cast<double>(detected.size()) < kEnough * beams_)
      wanted_m = std::max(wanted_m, kGrow * received_range_m);
    range_m_ = std::clamp(std::ceil(wanted_m / kStep_m) * kStep_m, std::min(kStep_m, longest_m_), longest_m_);
  }

 private:
  static constexpr double kFewest = 0.1;  // share of beams with a detection
  static constexpr double kEnough = 0.6;
  static constexpr double kMargin = 1.13;  // room for the outermost footprint, and for roll until the next ping
  static constexpr double kGrow = 1.1;
  static constexpr double kStep_m = 1.0;
  static constexpr double kOuter = 0.75;  // share of the half swath beyond which a beam shows its edge

  /// Range of the bottom at the swath's edge, were it as level beyond this beam as it is up to there. So beams that
  /// received nothing because the range was too short do not shorten it further.
  double edge_range_m(const BottomDetection& detected) const {
    const double angle = std::abs(detected.beam_angle_rad);
    if (angle < kOuter * half_swath_rad_) return detected.range_m;
    return detected.range_m * std::cos(angle) / std::cos(half_swath_rad_);
  }

  double longest_m_;
  double half_swath_rad_;
  int beams_;
  double range_m_;
  std::vector<double> edges_m_;
};

}  // namespace ensonify
