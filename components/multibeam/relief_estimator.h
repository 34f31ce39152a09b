#pragma once

#include <span>
#include <vector>

#include "kernels/survey/uncertainty/sounding.h"

namespace ensonify {

/// Distance of soundings from the points that they claim, by place in the swath, judged by how the profiles of the last
/// pings bend from footprint to footprint. Places next to each other and pings before count as samples of one seabed,
/// whose bends grow with the footprint.
class ReliefEstimator {
 public:
  struct Sounding {
    int place = 0;  // in the swath, ascending
    uncertainty::ProfilePoint point;
  };

  void take(std::span<const Sounding> ping);

  /// Standard deviation of the height; 0 where nothing was learned yet. `aspect`: the footprint's width along the track
  /// over that across; beyond 4 it counts as 4.
  double sd_m(int place, double footprint_m, double aspect) const;

 private:
  struct Mean {
    double bend_m2 = 0.0, weight = 0.0;  // bends as of a footprint of 1 m
  };
  std::vector<Mean> by_place_;
  double most_weight_ = 0.0;  // of any place
  std::vector<uncertainty::ProfilePoint> profile_;
};

}  // namespace ensonify
