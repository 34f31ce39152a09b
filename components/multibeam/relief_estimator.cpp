#include "components/multibeam/relief_estimator.h"

#include <algorithm>
#include <cmath>

namespace ensonify {
namespace {

constexpr double kKept = 0.98;    // from ping to ping: fifty pings are remembered
constexpr int kNeighbours = 4;    // places to either side
constexpr double kHurst = 0.625;  // a seabed's spectrum falls as k^-3.25 in two dimensions; 0.35 to 0.9 were measured

/// How a variance of bends grows with the footprint.
double growth(double footprint_m) { return std::pow(footprint_m, 2.0 * kHurst); }

/// unresolved_share between aspects that are tabled.
double share_of(double aspect) {
  constexpr double kStep = 0.25, kMost = 4.0;
  static const std::vector<double> kShares = [] {
    std::vector<double> shares;
    for (double at = 0.0; at <= kMost + kStep; at += kStep) shares.push_back(uncertainty::unresolved_share(kHurst, at));
    return shares;
  }();
  const double steps = std::clamp(aspect, 0.0, kMost) / kStep;
  const auto below = static_cast<std::size_t>(steps);
  return std::lerp(kShares[below], kShares[below + 1], steps - static_cast<double>(below));
}

}  // namespace

void ReliefEstimator::take(std::span<const Sounding> ping) {
  profile_.clear();
  for (const Sounding& sounding : ping) profile_.push_back(sounding.point);
  const std::vector<double> bends = uncertainty::squared_bends_m2(profile_);
  most_weight_ *= kKept;
  for (Mean& mean : by_place_) {
    mean.bend_m2 *= kKept;
    mean.weight *= kKept;
  }
  for (std::size_t i = 0; i < ping.size(); ++i) {
    const auto place = static_cast<std::size_t>(ping[i].place);
    if (place >= by_place_.size()) by_place_.resize(place + 1);
    if (std::isnan(bends[i])) continue;
    by_place_[place].bend_m2 += bends[i] / growth(ping[i].point.footprint_m);
    by_place_[place].weight += 1.0;
    most_weight_ = std::max(most_weight_, by_place_[place].weight);
  }
}

double ReliefEstimator::sd_m(int place, double footprint_m, double aspect) const {
  // Profiles end two footprints before the swath does: the places next to what is known indicate the rest. Now and then
  // a profile reaches farther, where its last sounding lies far out, and then it bends more than others: places that
  // few pings know do not count.
  const int places = static_cast<int>(by_place_.size());
  const auto known = [&](int at) { return by_place_[static_cast<std::size_t>(at)].weight > 0.5 * most_weight_; };
  for (int reach = kNeighbours; reach < places; reach *= 2) {
    Mean sum;
    for (int at = std::max(0, place - reach); at <= std::min(places - 1, place + reach); ++at) {
      if (!known(at)) continue;
      const Mean& mean = by_place_[static_cast<std::size_t>(at)];
      sum.bend_m2 += mean.bend_m2;
      sum.weight += mean.weight;
    }
    if (sum.weight > 0.0) {
      return std::sqrt(share_of(aspect) * growth(footprint_m) * std::max(0.0, sum.bend_m2 / sum.weight));
    }
  }
  return 0.0;
}

}  // namespace ensonify
