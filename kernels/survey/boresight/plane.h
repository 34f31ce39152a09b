#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/base/frames/attitude.h"

namespace ensonify::boresight {

/// A sounding by its line and its number in it.
struct SoundingRef {
  std::uint32_t line = 0;
  std::uint32_t index = 0;
};

/// Cell with soundings of at least two lines: `members` holds the soundings, line by line.
struct Cell {
  std::span<const SoundingRef> members;
};

/// The squares of `side_m` on the ground in which at least two lines have `least` soundings or more, from the
/// south-west on, row by row; lines with fewer are left out of a cell. A corner of the squares lies at `corner_m`
/// (east, north). The order depends on the soundings alone.
class Cells {
 public:
  Cells(const std::vector<std::vector<frames::Vec3>>& places_enu_m, double side_m, std::size_t least,
        const frames::Vec2& corner_m);

  std::size_t size() const { return starts_.empty() ? 0 : starts_.size() - 1; }
  Cell operator[](std::size_t n) const {
    return {std::span(members_).subspan(starts_[n], starts_[n + 1] - starts_[n])};
  }

 private:
  std::vector<SoundingRef> members_;
  std::vector<std::size_t> starts_;
};

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using Places = std::vector<std::vector<frames::Vec3>>;  // by line
using Members = std::vector<SoundingRef>;

/// The plane through the soundings of a cell, by least squares.
class Plane {
 public:
  Plane(const Members& members, const Places& places);

  double sigma_m() const { return sigma_m_; }             // about the plane; 0 of three soundings or fewer
  const Vector& residual_m() const { return residual_; }  // of each member, upwards

  /// Change of a residual when its sounding moves east, north and up. The plane's slopes come from
  /// noisy soundings: taken as they are, they would make a level bottom seem to give shifts along the track. So they
  /// are reduced by what noise alone would give, twice its deviation or less counting as none.
  Eigen::RowVector3d across() const;

  /// Residuals of the members `from` to `from + count` if the plane were laid without them.
  Vector without_it(Eigen::Index from, Eigen::Index count) const;

  /// Takes what a plane can explain out of the columns of `m`.
  void project_out(Matrix& m) const { m -= shape_ * normal_.solve(shape_.transpose() * m); }

 private:
  Eigen::Matrix<double, Eigen::Dynamic, 3> shape_;
  Eigen::LDLT<Eigen::Matrix3d> normal_;
  frames::Vec3 level_ = frames::Vec3::Zero();  // height at the centre, and its rise to the east and north
  Vector residual_;
  double sigma_m_ = 0.0;
};

}  // namespace ensonify::boresight
