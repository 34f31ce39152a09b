#include "kernels/survey/grid/soundings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace ensonify::survey_grid {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeastSd_m = 1e-3;   // a sounding that states less does not outweigh all others
constexpr double kOf95 = 1.959964;    // a normal variable lies within so many standard deviations in 95 % of the cases
constexpr double kFarthest_m = 1e12;  // from the origin: beyond any coordinate, and cells still have numbers

std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

}  // namespace

void CellSums::add(double depth_m, double sd_m) {
  if (count_ == 0) first_m_ = least_m_ = most_m_ = depth_m;
  ++count_;
  const double off = depth_m - first_m_;
  sum_m_ += off;
  squares_m2_ += off * off;
  least_m_ = std::min(least_m_, depth_m);
  most_m_ = std::max(most_m_, depth_m);
  if (!(sd_m >= 0.0)) return;
  const double sd = std::max(sd_m, kLeastSd_m);
  ++stated_;
  weights_ += 1.0 / (sd * sd);
  weighted_sum_ += off / (sd * sd);
  variances_m2_ += sd * sd;
}

double CellSums::mean_m() const { return count_ == 0 ? kNone : first_m_ + sum_m_ / count_; }
double CellSums::shoalest_m() const { return count_ == 0 ? kNone : least_m_; }
double CellSums::deepest_m() const { return count_ == 0 ? kNone : most_m_; }

double CellSums::sd_m() const {
  if (count_ < 2) return kNone;
  return std::sqrt(std::max(0.0, (squares_m2_ - sum_m_ * sum_m_ / count_) / (count_ - 1)));
}

double CellSums::weighted_m() const { return weighted() ? first_m_ + weighted_sum_ / weights_ : mean_m(); }

double CellSums::stated_sd_m() const { return stated_ == 0 ? kNone : std::sqrt(variances_m2_ / stated_); }

double CellSums::uncertainty_m() const { return kOf95 * std::fmax(stated_sd_m(), sd_m()); }

SoundingGrid::SoundingGrid(double cell_m) : cell_m_(cell_m) {
  if (!(cell_m > 0.0) || !std::isfinite(cell_m)) throw std::invalid_argument("a grid's cells need a side above 0");
}

void SoundingGrid::add(double east_m, double north_m, double depth_m, double sd_m) {
  if (!(std::abs(east_m) < kFarthest_m * cell_m_ && std::abs(north_m) < kFarthest_m * cell_m_) ||
      !std::isfinite(depth_m))
    return;
  const auto column = static_cast<std::int64_t>(std::floor(east_m / cell_m_));
  const auto row = static_cast<std::int64_t>(std::floor(north_m / cell_m_));
  const At at{floor_div(row, kBlock), floor_div(column, kBlock)};
  if (last_.second == nullptr || last_.first != at) {
    auto& block = blocks_[at];
    if (!block) block = std::make_unique<Block>();
    last_ = {at, block.get()};
  }
  (*last_.second)[static_cast<std::size_t>((row - at.first * kBlock) * kBlock + column - at.second * kBlock)].add(
      depth_m, sd_m);
  ++soundings_;
}

SoundingGrid::Frame SoundingGrid::frame() const {
  constexpr std::int64_t kFar = std::numeric_limits<std::int64_t>::max();
  std::int64_t west = kFar, east = -kFar, south = kFar, north = -kFar;
  each([&](std::int64_t column, std::int64_t row, const CellSums&) {
    west = std::min(west, column), east = std::max(east, column);
    south = std::min(south, row), north = std::max(north, row);
  });
  if (west > east) return {};
  return {west, south, east - west + 1, north - south + 1};
}

const CellSums& SoundingGrid::at(std::int64_t column, std::int64_t row) const {
  static const CellSums kEmpty;
  const At at{floor_div(row, kBlock), floor_div(column, kBlock)};
  const auto block = blocks_.find(at);
  if (block == blocks_.end()) return kEmpty;
  return (*block->second)[static_cast<std::size_t>((row - at.first * kBlock) * kBlock + column - at.second * kBlock)];
}

}  // namespace ensonify::survey_grid
