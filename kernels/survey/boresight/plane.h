#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "kernels/survey/boresight/cells.h"

namespace ensonify::boresight {

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
