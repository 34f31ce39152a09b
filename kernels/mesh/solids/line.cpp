#include "kernels/mesh/solids/line.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>

#include "kernels/mesh/solids/facet.h"

namespace ensonify::solids {
namespace {

using frames::Vec3;

constexpr double kFewestSides = 8.0, kMostSides = 100.0, kMostSidesOfLink = 16.0, kMostTriangles = 1e6;
constexpr int kMostPieces = 4000, kMostPartsOfLink = 8;              // of a catenary, of half a link's round
constexpr double kPitch = 4.0, kLinkLength = 6.0, kLinkWidth = 3.6;  // of a chain's links, in diameters of its wire

double sides_of(double radius_m, double sagitta_m, double most) {
  const double half_rad = std::acos(std::max(0.5, 1.0 - sagitta_m / std::max(radius_m, 1e-9)));
  return std::clamp(std::ceil(std::numbers::pi / half_rad), kFewestSides, most);
}

/// Rings of sides about the points of a line, and the faces between them.
class Sweep {
 public:
  Sweep(Surface& surface, double radius_m, double sagitta_m, double most_sides)
      : surface_(surface),
        radius_m_(radius_m),
        sides_(static_cast<std::uint32_t>(sides_of(radius_m, sagitta_m, most_sides))) {}

  void rope(std::span<const Vec3> line_m) {
    require_room(line_m.size());
    for (std::size_t i = 0; i < line_m.size(); ++i) {
      const Vec3 in = (line_m[i] - line_m[i == 0 ? 0 : i - 1]).normalized();
      const Vec3 out = (line_m[i + 1 == line_m.size() ? i : i + 1] - line_m[i]).normalized();
      ring(line_m[i], in + out);
    }
    for (std::size_t i = 0; i + 1 < line_m.size(); ++i) join(i, i + 1);
    cap(line_m.front(), 0, false);
    cap(line_m.back(), line_m.size() - 1, true);
  }

  void loop(std::span<const Vec3> line_m) {
    require_room(line_m.size());
    const std::size_t count = line_m.size();
    for (std::size_t i = 0; i < count; ++i)
      ring(line_m[i], (line_m[i] - line_m[(i + count - 1) % count]).normalized() +
                          (line_m[(i + 1) % count] - line_m[i]).normalized());
    for (std::size_t i = 0; i < count; ++i) join(i, (i + 1) % count);
  }

 private:
  void require_room(std::size_t points) const {
    const double more = 2.0 * sides_ * static_cast<double>(points + 1);
    if (more + static_cast<double>(surface_.mesh.triangle.size()) > kMostTriangles)
      throw std::invalid_argument("line: takes more than a million triangles: allow a greater sagitta");
  }

  /// Across the line, its first spoke turned as little as can be from that of the ring before.
  void ring(const Vec3& middle_m, const Vec3& along) {
    const Vec3 tangent = along.normalized();
    if (first_.empty()) spoke_ = tangent.unitOrthogonal();
    else spoke_ = Eigen::Quaterniond::FromTwoVectors(tangent_, tangent) * spoke_;
    spoke_ = (spoke_ - spoke_.dot(tangent) * tangent).normalized();
    tangent_ = tangent;
    first_.push_back(static_cast<std::uint32_t>(surface_.mesh.vertex_m.size()));
    const Vec3 other = tangent.cross(spoke_);
    for (std::uint32_t side = 0; side < sides_; ++side) {
      const double turn = 2.0 * std::numbers::pi * side / sides_;
      normal_.push_back(std::cos(turn) * spoke_ + std::sin(turn) * other);
      surface_.mesh.vertex_m.push_back((middle_m + radius_m_ * normal_.back()).cast<float>());
    }
  }

  void join(std::size_t from, std::size_t to) {
    for (std::uint32_t side = 0; side < sides_; ++side) {
      const std::uint32_t next = (side + 1) % sides_;
      face({{{from, side}, {from, next}, {to, next}}});
      face({{{from, side}, {to, next}, {to, side}}});
    }
  }

  struct Corner {
    std::size_t ring;
    std::uint32_t side;
  };
  void face(const std::array<Corner, 3>& corners) {
    progressive::Triangle triangle;
    for (std::size_t c = 0; c < 3; ++c) triangle[c] = first_[corners[c].ring] + corners[c].side;
    std::array<float, 3> bulge{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = triangle[c], b = triangle[(c + 1) % 3];
      bulge[c] = std::max(0.0F, bulge_m(place(a), place(b), normal_[a - first_.front()], normal_[b - first_.front()]));
    }
    surface_.mesh.triangle.push_back(triangle);
    surface_.bulge_m.push_back(bulge);
  }

  void cap(const Vec3& middle_m, std::size_t ring, bool last) {
    const auto middle = static_cast<std::uint32_t>(surface_.mesh.vertex_m.size());
    surface_.mesh.vertex_m.push_back(middle_m.cast<float>());
    for (std::uint32_t side = 0; side < sides_; ++side) {
      const std::uint32_t a = first_[ring] + side, b = first_[ring] + (side + 1) % sides_;
      surface_.mesh.triangle.push_back(last ? progressive::Triangle{middle, a, b}
                                            : progressive::Triangle{middle, b, a});
      surface_.bulge_m.push_back({});
    }
  }

  Vec3 place(std::uint32_t vertex) const { return surface_.mesh.vertex_m[vertex].cast<double>(); }

  Surface& surface_;
  double radius_m_;
  std::uint32_t sides_;
  std::vector<std::uint32_t> first_;  // vertex of each ring
  std::vector<Vec3> normal_;          // of each vertex of a ring
  Vec3 spoke_ = Vec3::Zero(), tangent_ = Vec3::Zero();
};

/// Points of a line by the way along it.
class Way {
 public:
  explicit Way(std::span<const Vec3> line_m) : line_m_(line_m) {
    for (std::size_t i = 1; i < line_m.size(); ++i) at_m_.push_back(at_m_.back() + (line_m[i] - line_m[i - 1]).norm());
  }
  double length_m() const { return at_m_.back(); }
  Vec3 at(double way_m) const {
    const auto next = std::ranges::upper_bound(at_m_.begin() + 1, at_m_.end() - 1, way_m) - at_m_.begin();
    const auto i = static_cast<std::size_t>(next);
    const double share = (way_m - at_m_[i - 1]) / std::max(at_m_[i] - at_m_[i - 1], 1e-12);
    return line_m_[i - 1] + share * (line_m_[i] - line_m_[i - 1]);
  }

 private:
  std::span<const Vec3> line_m_;
  std::vector<double> at_m_{0.0};
};

/// The middle line of a link about the origin, along x, wide along y.
std::vector<Vec3> link(double wire_m, double sagitta_m) {
  const double round_m = 0.5 * (kLinkWidth - 1.0) * wire_m, straight_m = 0.5 * (kLinkLength - kLinkWidth) * wire_m;
  const double half_rad = std::acos(std::max(0.5, 1.0 - sagitta_m / round_m));
  const int parts = std::clamp(static_cast<int>(std::ceil(0.5 * std::numbers::pi / half_rad)), 4, kMostPartsOfLink);
  std::vector<Vec3> line;
  for (const double end : {1.0, -1.0}) {
    for (int i = 0; i <= parts; ++i) {
      const double turn = std::numbers::pi * (static_cast<double>(i) / parts - 0.5);
      line.push_back(end * Vec3(straight_m + round_m * std::cos(turn), round_m * std::sin(turn), 0.0));
    }
  }
  return line;
}

void require(bool holds, const char* why) {
  if (!holds) throw std::invalid_argument(why);
}

}  // namespace

std::vector<Vec3> catenary(double length_m, double sag_m, double sagitta_m) {
  require(length_m > 0.0 && sag_m >= 0.0, "line: its length is not above 0 m, or its sag below");
  const double half_m = 0.5 * length_m;
  if (sag_m < 1e-6 * length_m) return {{0.0, -half_m, 0.0}, {0.0, half_m, 0.0}};
  // sag / half = (cosh u - 1) / u, where u is half the length over the catenary's parameter: it rises with u.
  double low = 0.0, high = 1.0;
  const auto sag_over_half = [](double u) { return (std::cosh(u) - 1.0) / u; };
  while (sag_over_half(high) < sag_m / half_m) high *= 2.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (sag_over_half(middle) < sag_m / half_m ? low : high) = middle;
  }
  const double parameter_m = half_m / high, arc_m = 2.0 * parameter_m * std::sinh(high);
  const double wanted = std::ceil(arc_m / std::sqrt(8.0 * parameter_m * sagitta_m));
  const int pieces = static_cast<int>(std::clamp(wanted, 2.0, static_cast<double>(kMostPieces)));
  std::vector<Vec3> line;
  for (int i = 0; i <= pieces; ++i) {
    const double u = std::asinh((static_cast<double>(i) / pieces - 0.5) * arc_m / parameter_m);
    line.emplace_back(0.0, parameter_m * u, parameter_m * (std::cosh(u) - 1.0) - 0.5 * sag_m);
  }
  return line;
}

std::vector<double> laid_heights(std::span<const double> along_m, std::span<const double> ground_m, double taut_m) {
  require(along_m.size() == ground_m.size(), "line: has not a height for each place");
  std::vector<double> laid(ground_m.begin(), ground_m.end());
  if (!(taut_m > 0.0)) return laid;
  // Less the parabola, what spans freely is straight and what lies is above it: the upper hull of the ground.
  const auto parabola = [&](std::size_t i) { return 0.5 * along_m[i] * along_m[i] / taut_m; };
  const auto bent = [&](std::size_t i) { return ground_m[i] - parabola(i); };
  std::vector<std::size_t> hull;
  for (std::size_t i = 0; i < ground_m.size(); ++i) {
    const auto below = [&] {  // the last one, the way from the one before to this
      const std::size_t a = hull[hull.size() - 2], b = hull.back();
      return (bent(b) - bent(a)) * (along_m[i] - along_m[a]) <= (bent(i) - bent(a)) * (along_m[b] - along_m[a]);
    };
    while (hull.size() > 1 && below()) hull.pop_back();
    hull.push_back(i);
  }
  for (std::size_t h = 1; h < hull.size(); ++h) {
    const std::size_t a = hull[h - 1], b = hull[h];
    for (std::size_t i = a + 1; i < b; ++i) {
      const double share = (along_m[i] - along_m[a]) / (along_m[b] - along_m[a]);
      laid[i] = std::max(ground_m[i], bent(a) + share * (bent(b) - bent(a)) + parabola(i));
    }
  }
  return laid;
}

Surface rope_along(std::span<const Vec3> line_m, double diameter_m, double sagitta_m) {
  require(diameter_m > 0.0 && line_m.size() > 1, "line: its diameter is not above 0 m, or it has no two points");
  Surface surface;
  Sweep(surface, 0.5 * diameter_m, sagitta_m, kMostSides).rope(line_m);
  return surface;
}

Surface chain_along(std::span<const Vec3> line_m, double wire_m, double sagitta_m) {
  require(wire_m > 0.0 && line_m.size() > 1, "line: its diameter is not above 0 m, or it has no two points");
  const Way way(line_m);
  const double pitch_m = kPitch * wire_m, reach_m = 0.5 * pitch_m;
  const int links = std::max(1, static_cast<int>(way.length_m() / pitch_m));
  const std::vector<Vec3> one = link(wire_m, sagitta_m);
  Surface surface;
  for (int i = 0; i < links; ++i) {
    const double middle_m = way.length_m() * (i + 0.5) / links;
    const Vec3 middle = way.at(middle_m);
    const Vec3 along =
        (way.at(std::min(way.length_m(), middle_m + reach_m)) - way.at(std::max(0.0, middle_m - reach_m))).normalized();
    Eigen::Matrix3d turn;
    turn.col(0) = along;
    turn.col(1) = Vec3::UnitZ().cross(along).norm() > 1e-6 ? Vec3(Vec3::UnitZ().cross(along).normalized())
                                                           : Vec3(along.unitOrthogonal());
    turn.col(2) = turn.col(0).cross(turn.col(1));
    if (i % 2 == 1) turn = turn * Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()).toRotationMatrix();
    std::vector<Vec3> placed;
    for (const Vec3& point : one) placed.push_back(middle + turn * point);
    Sweep(surface, 0.5 * wire_m, sagitta_m, kMostSidesOfLink).loop(placed);
  }
  return surface;
}

}  // namespace ensonify::solids
