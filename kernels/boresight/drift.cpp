#include "kernels/boresight/drift.h"

#include <cmath>

namespace ensonify::boresight {

namespace {

constexpr double kFixed = 1e24;  // inverse variance of what is known

}  // namespace

Drift::Drift(const std::vector<Line>& lines, const AdjustSettings& settings) : wander_s_(settings.wander_s) {
  for (const Line& line : lines) {
    const double start_s = line.soundings.empty() ? 0.0 : line.soundings.front().time_s;
    const double lasts_s = line.soundings.empty() ? 0.0 : line.soundings.back().time_s - start_s;
    std::array<Pieces, kAxes>& pieces = pieces_.emplace_back();
    for (std::size_t k = 0; k < kAxes; ++k) {
      const double length_s = k == 2 ? settings.height_piece_s : settings.piece_s;
      const auto axis = static_cast<Eigen::Index>(k % 3);
      pieces[k] = {size_, static_cast<Eigen::Index>(lasts_s / length_s) + 1, start_s, length_s,
                   k < 3 ? line.position_sd_m[axis] : line.rotation_sd_rad[axis]};
      size_ += pieces[k].count;
    }
  }
}

Drift::Columns Drift::columns(std::size_t line, double time_s) const {
  Columns columns;
  for (std::size_t k = 0; k < kAxes; ++k) {
    const Pieces& p = pieces_[line][k];
    columns[k] = p.first + static_cast<Eigen::Index>((time_s - p.start_s) / p.length_s);
  }
  return columns;
}

Eigen::MatrixXd Drift::inverse_covariance() const {
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(size_, size_);
  for (const auto& line : pieces_) {
    for (const Pieces& p : line) {
      // Three diagonals: a piece tells of its neighbours, and through them of the rest.
      const double keep = std::exp(-p.length_s / wander_s_);
      const double fresh = p.sd > 0.0 ? 1.0 / (p.sd * p.sd * (1.0 - keep * keep)) : kFixed;
      for (Eigen::Index i = p.first; i < p.first + p.count; ++i) {
        const bool inner = i > p.first && i + 1 < p.first + p.count;
        inverse(i, i) = fresh * (p.count == 1 ? 1.0 - keep * keep : inner ? 1.0 + keep * keep : 1.0);
        if (i > p.first) inverse(i, i - 1) = inverse(i - 1, i) = -fresh * keep;
      }
    }
  }
  return inverse;
}

}  // namespace ensonify::boresight
