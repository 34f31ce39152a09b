#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "kernels/survey/boresight/adjust.h"

namespace ensonify::boresight {

/// Errors of each line's navigation, as unknowns behind the global ones: east, north, up, roll, pitch and
/// heading, constant over pieces of time. Heights wander with every wave that heave misses, so theirs are short. A line
/// goes on from where the one before it ended; lines that overlap in time are of different surveys.
class Drift {
 public:
  static constexpr std::size_t kAxes = 6;
  using Columns = std::array<Eigen::Index, kAxes>;  // places in the state

  Drift(const std::vector<Line>& lines, const AdjustSettings& settings);

  Eigen::Index size() const { return size_; }  // of the state
  Columns columns(std::size_t line, double time_s) const;

  /// Inverse covariance of a stationary first-order process through all lines, for each axis; zero for the global
  /// unknowns.
  Eigen::MatrixXd inverse_covariance() const;

  /// Pull of an error of 1 of each axis on each global unknown, in a stretch of time.
  using Pulls = Eigen::Matrix<double, kUnknowns, kAxes>;
  /// Variances of what that process as it is, not in pieces, does to the global unknowns, for each axis; `pulls` by
  /// line and stretch.
  Pulls variances(const std::vector<std::vector<Pulls>>& pulls, double stretch_s) const;

 private:
  struct Pieces {
    Eigen::Index first, count;
    double start_s, length_s, sd;
  };
  std::vector<std::array<Pieces, kAxes>> pieces_;  // by line
  std::array<double, kAxes> wander_s_;
  Eigen::Index size_ = static_cast<Eigen::Index>(kUnknowns);
};

}  // namespace ensonify::boresight
