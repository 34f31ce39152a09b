#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "tests/physics/area_integral.h"

/// How a head parts two points.
namespace ensonify::physics {

/// How far a signal (powers) falls between its highest point and another that is half as high at least, dB; 0 for one
/// peak.
inline double dip_db(const std::vector<double>& powers) {
  const auto peak = std::max_element(powers.begin(), powers.end());
  double dip = 0.0;
  const auto outward = [&](auto from, auto to) {
    double lowest = *peak;
    for (auto at = from; at != to; ++at) {
      lowest = std::min(lowest, *at);
      if (*at > 0.5 * *peak) dip = std::max(dip, db(*at / std::max(lowest, 1e-9 * *peak)));
    }
  };
  outward(peak, powers.end());
  outward(std::make_reverse_iterator(peak), powers.rend());
  return dip;
}

/// Of two points in some places between a head's samples.
struct Dips {
  double shallowest = 1e9, deepest = 0.0;

  void add(double dip) { shallowest = std::min(shallowest, dip), deepest = std::max(deepest, dip); }
};

}  // namespace ensonify::physics
