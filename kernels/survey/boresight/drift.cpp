#include "kernels/survey/boresight/drift.h"

#include <algorithm>
#include <cmath>

namespace ensonify::boresight {

namespace {

constexpr double kKnown = 1e-12;  // deviation of what does not err

}  // namespace

Drift::Drift(const std::vector<Line>& lines, const AdjustSettings& settings) {
  for (std::size_t k = 0; k < kAxes; ++k) wander_s_[k] = k < 3 ? settings.wander_s : settings.turn_wander_s;
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
  for (std::size_t k = 0; k < kAxes; ++k) {
    Eigen::Index before = -1;
    double before_s = 0.0, before_sd = 1.0;
    for (const auto& line : pieces_) {
      const Pieces& p = line[k];
      const double sd = std::max(p.sd, kKnown);
      for (Eigen::Index i = 0; i < p.count; ++i) {
        // x = keep x_before + fresh: a piece indicates its neighbours, and through them of the rest.
        const double at_s = p.start_s + static_cast<double>(i) * p.length_s;
        const double keep = before >= 0 && at_s > before_s ? std::exp((before_s - at_s) / wander_s_[k]) : 0.0;
        const double fresh = 1.0 / (1.0 - keep * keep);
        const Eigen::Index here = p.first + i;
        inverse(here, here) += fresh / (sd * sd);
        if (keep > 0.0) {
          inverse(before, before) += keep * keep * fresh / (before_sd * before_sd);
          inverse(here, before) = inverse(before, here) = -keep * fresh / (sd * before_sd);
        }
        before = here;
        before_s = at_s;
        before_sd = sd;
      }
    }
  }
  return inverse;
}

Drift::Pulls Drift::variances(const std::vector<std::vector<Pulls>>& pulls, double stretch_s) const {
  Pulls variances = Pulls::Zero();
  for (std::size_t k = 0; k < kAxes; ++k) {
    Unknowns before = Unknowns::Zero();  // what lies before, as far as it is remembered
    double before_s = 0.0;
    for (std::size_t line = 0; line < pulls.size(); ++line) {
      const Pieces& p = pieces_[line][k];
      for (std::size_t n = 0; n < pulls[line].size(); ++n) {
        const double at_s = p.start_s + static_cast<double>(n) * stretch_s;
        before *= at_s > before_s ? std::exp((before_s - at_s) / wander_s_[k]) : 0.0;
        const Unknowns here = p.sd * pulls[line][n].col(static_cast<Eigen::Index>(k));
        variances.col(static_cast<Eigen::Index>(k)) += here.cwiseProduct(here + 2.0 * before);
        before += here;
        before_s = at_s;
      }
    }
  }
  return variances;
}

}  // namespace ensonify::boresight
