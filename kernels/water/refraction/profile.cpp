#include "kernels/water/refraction/profile.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace ensonify::refraction {
namespace {

std::string nameof(std::size_t index, const Knot& knot) {
  return "sound speed profile, knot " + std::to_string(index + 1) + " (" + std::to_string(knot.depth_m) + " m, " +
         std::to_string(knot.speed_mps) + " m/s): ";
}

void check(std::span<const Knot> knots) {
  if (knots.empty()) throw std::invalid_argument("a sound speed profile needs at least one knot");
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i].depth_m)) throw std::invalid_argument(nameof(i, knots[i]) + "the depth is not finite");
    if (i > 0 && !(knots[i].depth_m > knots[i - 1].depth_m)) {
      throw std::invalid_argument(nameof(i, knots[i]) + "depths must rise from knot to knot");
    }
    if (!(knots[i].speed_mps >= SoundSpeedProfile::kSlowest_mps &&
          knots[i].speed_mps <= SoundSpeedProfile::kFastest_mps)) {
      throw std::invalid_argument(nameof(i, knots[i]) + "the speed must lie in 1300..1700 m/s");
    }
  }
}

/// Marks the knots to keep between two kept ones.
void keep_between(std::span<const Knot> knots, std::size_t first, std::size_t last, double tolerance_mps,
                  std::vector<bool>& keep) {
  const Knot &a = knots[first], &b = knots[last];
  const double slope = (b.speed_mps - a.speed_mps) / (b.depth_m - a.depth_m);
  std::size_t worst = first;
  double worst_mps = tolerance_mps;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double off = std::abs(knots[i].speed_mps - a.speed_mps - slope * (knots[i].depth_m - a.depth_m));
    if (off > worst_mps) worst = i, worst_mps = off;
  }
  if (worst == first) return;
  keep[worst] = true;
  keep_between(knots, first, worst, tolerance_mps, keep);
  keep_between(knots, worst, last, tolerance_mps, keep);
}

}  // namespace

SoundSpeedProfile::SoundSpeedProfile(std::vector<Knot> knots) : knots_(std::move(knots)) {
  check(knots_);
  gradient_per_s_.assign(layers(), 0.0);
  for (std::size_t i = 1; i < knots_.size(); ++i) {
    gradient_per_s_[i] = (knots_[i].speed_mps - knots_[i - 1].speed_mps) / (knots_[i].depth_m - knots_[i - 1].depth_m);
  }
}

SoundSpeedProfile SoundSpeedProfile::uniform(double speed_mps) { return SoundSpeedProfile({{0.0, speed_mps}}); }

std::size_t SoundSpeedProfile::layer_at(double depth_m) const {
  const auto below = std::upper_bound(knots_.begin(), knots_.end(), depth_m,
                                      [](double depth, const Knot& knot) { return depth < knot.depth_m; });
  return static_cast<std::size_t>(below - knots_.begin());
}

double SoundSpeedProfile::speed_mps(double depth_m) const { return speed_in_layer_mps(layer_at(depth_m), depth_m); }

double SoundSpeedProfile::gradient_per_s(double depth_m) const { return gradient_per_s_[layer_at(depth_m)]; }

SoundSpeedProfile SoundSpeedProfile::thinned(double tolerance_mps) const {
  if (!(tolerance_mps >= 0.0)) throw std::invalid_argument("the tolerance of a thinned profile must not be negative");
  std::vector<bool> keep(knots_.size(), false);
  keep.front() = keep.back() = true;
  if (knots_.size() > 2) keep_between(knots_, 0, knots_.size() - 1, tolerance_mps, keep);
  std::vector<Knot> kept;
  for (std::size_t i = 0; i < knots_.size(); ++i) {
    if (keep[i]) kept.push_back(knots_[i]);
  }
  return SoundSpeedProfile(std::move(kept));
}

}  // namespace ensonify::refraction
