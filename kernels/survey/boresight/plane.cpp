#include "kernels/survey/boresight/plane.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ensonify::boresight {
namespace {

struct Filed {
  std::int64_t row, column;
  SoundingRef ref;
  auto key() const { return std::tuple(row, column, ref.line, ref.index); }
};

std::vector<Filed> filed(const std::vector<std::vector<frames::Vec3>>& places_enu_m, double side_m,
                         const frames::Vec2& corner_m) {
  const auto square = [&](double along_m) { return std::llround(std::floor(along_m / side_m)); };
  std::vector<Filed> all;
  for (std::uint32_t line = 0; line < places_enu_m.size(); ++line) {
    for (std::uint32_t i = 0; i < places_enu_m[line].size(); ++i) {
      const frames::Vec3& p = places_enu_m[line][i];
      all.push_back({square(p.y() - corner_m.y()), square(p.x() - corner_m.x()), {line, i}});
    }
  }
  std::sort(all.begin(), all.end(), [](const Filed& a, const Filed& b) { return a.key() < b.key(); });
  return all;
}

}  // namespace

Cells::Cells(const std::vector<std::vector<frames::Vec3>>& places_enu_m, double side_m, std::size_t least,
             const frames::Vec2& corner_m) {
  const std::vector<Filed> all = filed(places_enu_m, side_m, corner_m);
  starts_.push_back(0);
  for (auto from = all.begin(); from != all.end();) {
    const auto to =
        std::find_if(from, all.end(), [&](const Filed& f) { return f.row != from->row || f.column != from->column; });
    int lines = 0;
    for (auto first = from; first != to;) {
      const auto last = std::find_if(first, to, [&](const Filed& f) { return f.ref.line != first->ref.line; });
      if (static_cast<std::size_t>(last - first) >= least) {
        ++lines;
        for (; first != last; ++first) members_.push_back(first->ref);
      }
      first = last;
    }
    if (lines >= 2) {
      starts_.push_back(members_.size());
    } else {
      members_.resize(starts_.back());
    }
    from = to;
  }
}

using frames::Vec3;

Plane::Plane(const Members& members, const Places& places) {
  const auto place = [&](Eigen::Index i) -> const Vec3& {
    const SoundingRef& ref = members[static_cast<std::size_t>(i)];
    return places[ref.line][ref.index];
  };
  const auto n = static_cast<Eigen::Index>(members.size());
  Vec3 centre = Vec3::Zero();
  for (Eigen::Index i = 0; i < n; ++i) centre += place(i) / static_cast<double>(n);
  Vector height(n);
  shape_.resize(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec3 p = place(i) - centre;
    shape_.row(i) << 1.0, p.x(), p.y();
    height[i] = p.z();
  }
  constexpr double kTiny = 1e-9;  // soundings in one row: level across
  normal_.compute(shape_.transpose() * shape_ + kTiny * Eigen::Matrix3d::Identity());
  level_ = normal_.solve(shape_.transpose() * height);
  residual_ = height - shape_ * level_;
  sigma_m_ = n > 3 ? std::sqrt(residual_.squaredNorm() / static_cast<double>(n - 3)) : 0.0;
}

Eigen::RowVector3d Plane::across() const {
  const Eigen::Matrix3d inverse = normal_.solve(Eigen::Matrix3d::Identity());
  const double noise2 = sigma_m_ * sigma_m_ * (inverse(1, 1) + inverse(2, 2));
  const double slope2 = level_[1] * level_[1] + level_[2] * level_[2];
  const double share = slope2 > 0.0 ? std::max(0.0, 1.0 - 4.0 * noise2 / slope2) : 0.0;
  return {-share * level_[1], -share * level_[2], 1.0};
}

Vector Plane::without_it(Eigen::Index from, Eigen::Index count) const {
  constexpr double kAlone = 1.01;  // a part that alone holds the plane has no residual: it stays small
  const auto part = shape_.middleRows(from, count);
  const Matrix hat = part * normal_.solve(part.transpose());
  return (kAlone * Matrix::Identity(count, count) - hat).ldlt().solve(residual_.segment(from, count));
}

}  // namespace ensonify::boresight
