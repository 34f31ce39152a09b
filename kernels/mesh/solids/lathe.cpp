#include "kernels/mesh/solids/lathe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "kernels/mesh/solids/facet.h"

namespace ensonify::solids {
namespace {

using frames::Vec2;
using frames::Vec3;

constexpr int kFewestSides = 12, kMostSides = 10'000;
constexpr double kMostTriangles = 1e6;

Vec2 turned_by(const Vec2& v, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

/// The rings of vertices of an outline's points; on the axis a ring is one vertex.
class Rings {
 public:
  Rings(progressive::TriangleMesh& mesh, std::uint32_t sides) : mesh_(mesh), sides_(sides) {}

  static bool on_axis(const Vec2& point_m) { return point_m.x() <= 0.0; }

  std::uint32_t vertex(const Vec2& point_m, std::uint32_t side) {
    const auto [at, is_new] = first_.try_emplace({point_m.x(), point_m.y()}, mesh_.vertex_m.size());
    if (is_new) add(point_m);
    return at->second + (on_axis(point_m) ? 0 : side % sides_);
  }

 private:
  void add(const Vec2& point_m) {
    const std::uint32_t count = on_axis(point_m) ? 1 : sides_;
    for (std::uint32_t i = 0; i < count; ++i) {
      const double turn_rad = 2.0 * std::numbers::pi * i / sides_;
      mesh_.vertex_m.push_back(
          Vec3(point_m.x() * std::cos(turn_rad), point_m.x() * std::sin(turn_rad), point_m.y()).cast<float>());
    }
  }

  progressive::TriangleMesh& mesh_;
  std::uint32_t sides_;
  std::map<std::pair<double, double>, std::uint32_t> first_;  // by point
};

/// A corner of a triangle with the normal that the surface has there.
struct Corner {
  std::uint32_t vertex;
  Vec3 place_m, normal;
};

Corner corner(Rings& rings, const Vec2& point_m, const Vec2& normal, std::uint32_t side, std::uint32_t sides) {
  const double turn_rad = 2.0 * std::numbers::pi * side / sides, c = std::cos(turn_rad), s = std::sin(turn_rad);
  return {rings.vertex(point_m, side),
          {point_m.x() * c, point_m.x() * s, point_m.y()},
          {normal.x() * c, normal.x() * s, normal.y()}};
}

void add_triangle(const std::array<Corner, 3>& corners, Surface& surface) {
  std::array<float, 3> bulge{};
  for (std::size_t c = 0; c < 3; ++c) {
    const Corner &from = corners[c], &to = corners[(c + 1) % 3];
    bulge[c] = bulge_m(from.place_m, to.place_m, from.normal, to.normal);
  }
  surface.mesh.triangle.push_back({corners[0].vertex, corners[1].vertex, corners[2].vertex});
  surface.bulge_m.push_back(bulge);
}

}  // namespace

Outline& Outline::straight_to(const Vec2& to_m) {
  const Vec2 along = (to_m - here_m_).normalized(), normal(along.y(), -along.x());
  pieces_.push_back({here_m_, to_m, normal, normal});
  here_m_ = to_m;
  return *this;
}

Outline& Outline::arc(const Vec2& centre_m, double by_rad, double sagitta_m) {
  const Vec2 spoke = here_m_ - centre_m;
  const double half_rad = std::acos(std::max(0.5, 1.0 - sagitta_m / spoke.norm()));
  const int parts = std::max(2, static_cast<int>(std::ceil(by_rad / (2.0 * half_rad))));
  for (int i = 0; i < parts; ++i) {
    const Vec2 from = turned_by(spoke, by_rad * i / parts), to = turned_by(spoke, by_rad * (i + 1) / parts);
    pieces_.push_back({centre_m + from, centre_m + to, from.normalized(), to.normalized()});
    // The same numbers where pieces meet: vertices are found by them.
    pieces_.back().from_m = here_m_;
    here_m_ = pieces_.back().to_m;
  }
  return *this;
}

Outline& Outline::close() {
  const Vec2 start_m = pieces_.front().from_m;
  return (here_m_ - start_m).norm() < 1e-9 * start_m.norm() ? end_at(start_m) : straight_to(start_m);
}

Outline& Outline::end_at(const Vec2& point_m) {
  pieces_.back().to_m = here_m_ = point_m;
  return *this;
}

Surface turned(const Outline& outline, double sagitta_m) {
  double widest_m = 0.0;
  for (const OutlinePiece& piece : outline.pieces()) widest_m = std::max({widest_m, piece.from_m.x(), piece.to_m.x()});
  const double wanted =
      std::ceil(std::numbers::pi / std::acos(std::max(0.5, 1.0 - sagitta_m / std::max(widest_m, 1e-9))));
  if (wanted > kMostSides || 2.0 * wanted * static_cast<double>(outline.pieces().size()) > kMostTriangles)
    throw std::invalid_argument("solid: more than a million triangles for this sagitta");
  const auto sides = static_cast<std::uint32_t>(std::max<double>(kFewestSides, wanted));
  Surface surface;
  Rings rings(surface.mesh, sides);
  for (const OutlinePiece& piece : outline.pieces()) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const Corner a = corner(rings, piece.from_m, piece.normal_from, i, sides),
                   b = corner(rings, piece.from_m, piece.normal_from, i + 1, sides),
                   c = corner(rings, piece.to_m, piece.normal_to, i + 1, sides),
                   d = corner(rings, piece.to_m, piece.normal_to, i, sides);
      if (!Rings::on_axis(piece.from_m)) add_triangle({a, b, c}, surface);
      if (!Rings::on_axis(piece.to_m)) add_triangle({a, c, d}, surface);
    }
  }
  return surface;
}

Surface laid_down(Surface upright) {
  for (Eigen::Vector3f& vertex : upright.mesh.vertex_m) vertex = Eigen::Vector3f(vertex.x(), vertex.z(), -vertex.y());
  return upright;
}

}  // namespace ensonify::solids
