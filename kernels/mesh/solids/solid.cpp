#include "kernels/mesh/solids/solid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "kernels/mesh/solids/facet.h"
#include "kernels/mesh/solids/figure.h"
#include "kernels/mesh/solids/lathe.h"
#include "kernels/mesh/solids/line.h"

namespace ensonify::solids {
namespace {

using frames::Vec2;
using frames::Vec3;
using progressive::Triangle;
using progressive::TriangleMesh;

constexpr double kMostTriangles = 1e6;
constexpr int kFewestSides = 12;  // of a circle

void require(bool holds, const char* why) {
  if (!holds) throw std::invalid_argument(why);
}

void require_few(double triangles) {
  require(triangles <= kMostTriangles, "solid: takes more than a million triangles: allow a greater sagitta");
}

std::uint32_t add(TriangleMesh& mesh, const Vec3& vertex_m) {
  mesh.vertex_m.push_back(vertex_m.cast<float>());
  return static_cast<std::uint32_t>(mesh.vertex_m.size() - 1);
}

/// Two triangles; corners counterclockwise as seen from outside.
void add_rectangle(TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  mesh.triangle.push_back({a, b, c});
  mesh.triangle.push_back({a, c, d});
}

/// The icosahedron that is cut into a sphere: twelve corners, and twenty faces seen from outside.
struct Icosahedron {
  std::array<Vec3, 12> corner;
  static constexpr std::array<Triangle, 20> kFaces{{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
  Icosahedron() {
    const double g = std::numbers::phi;
    corner = {{{-1, g, 0},
               {1, g, 0},
               {-1, -g, 0},
               {1, -g, 0},
               {0, -1, g},
               {0, 1, g},
               {0, -1, -g},
               {0, 1, -g},
               {g, 0, -1},
               {g, 0, 1},
               {-g, 0, -1},
               {-g, 0, 1}}};
    for (Vec3& one : corner) one.normalize();
  }
};

/// Each side of the icosahedron cut into so many parts, all corners pushed out onto the sphere.
TriangleMesh sphere_of(double radius_m, int parts) {
  const Icosahedron base;
  TriangleMesh mesh;
  using Steps = std::array<int, 3>;                                            // towards a face's corners
  std::map<std::array<std::pair<std::uint32_t, int>, 3>, std::uint32_t> made;  // by the corners that it lies between
  for (const Triangle& face : Icosahedron::kFaces) {
    const auto vertex = [&](const Steps& steps) {
      std::array<std::pair<std::uint32_t, int>, 3> key;
      for (std::size_t c = 0; c < 3; ++c)
        key[c] = steps[c] > 0 ? std::pair(face[c], steps[c]) : std::pair(std::uint32_t{99}, 0);
      std::ranges::sort(key);
      const auto [at, is_new] = made.try_emplace(key, 0U);
      if (is_new) {
        Vec3 place = Vec3::Zero();
        for (const auto& [corner, share] : key) {
          if (share > 0) place += share * base.corner[corner];
        }
        at->second = add(mesh, radius_m * place.normalized());
      }
      return at->second;
    };
    for (int i = 0; i < parts; ++i) {
      for (int j = 0; i + j < parts; ++j) {
        const int k = parts - i - j;
        mesh.triangle.push_back({vertex({k, i, j}), vertex({k - 1, i + 1, j}), vertex({k - 1, i, j + 1})});
        if (k > 1)
          mesh.triangle.push_back(
              {vertex({k - 1, i + 1, j}), vertex({k - 2, i + 1, j + 1}), vertex({k - 1, i, j + 1})});
      }
    }
  }
  return mesh;
}

/// Greatest distance of a sphere from the triangles that stand for it.
double sagitta_of(const TriangleMesh& sphere, double radius_m) {
  double nearest_m = radius_m;  // of a triangle's circumcentre, from the middle
  for (const auto& [a, b, c] : sphere.triangle) {
    const Vec3 p = sphere.vertex_m[a].cast<double>(), q = sphere.vertex_m[b].cast<double>(),
               r = sphere.vertex_m[c].cast<double>();
    nearest_m = std::min(nearest_m, std::abs(p.dot((q - p).cross(r - p).normalized())));
  }
  return radius_m - nearest_m;
}

std::vector<std::array<float, 3>> bulges_of(const TriangleMesh& sphere) {
  std::vector<std::array<float, 3>> bulges;
  for (const auto& corners : sphere.triangle) {
    std::array<float, 3> bulge{};
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 a = sphere.vertex_m[corners[c]].cast<double>(),
                 b = sphere.vertex_m[corners[(c + 1) % 3]].cast<double>();
      bulge[c] = bulge_m(a, b, a.normalized(), b.normalized());
    }
    bulges.push_back(bulge);
  }
  return bulges;
}

Surface surface_of(const Sphere& sphere, double sagitta_m) {
  require(sphere.diameter_m > 0.0, "sphere: its diameter is not above 0 m");
  const double radius_m = 0.5 * sphere.diameter_m;
  // An equilateral triangle of side s on a sphere leaves it by s^2 / (6 radius); a face's middle is cut coarsest.
  const double side_m = std::sqrt(6.0 * radius_m * std::min(sagitta_m, 0.1 * radius_m));
  int parts = std::max(1, static_cast<int>(1.05 * radius_m / side_m));
  for (;; ++parts) {
    require_few(20.0 * parts * parts);
    TriangleMesh mesh = sphere_of(radius_m, parts);
    if (sagitta_of(mesh, radius_m) <= sagitta_m) return {mesh, bulges_of(mesh)};
  }
}

Surface surface_of(const Box& box, double) {
  require((box.size_m.array() > 0.0).all(), "box: a side is not above 0 m");
  TriangleMesh mesh;
  for (const double z : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      for (const double x : {-0.5, 0.5}) add(mesh, box.size_m.cwiseProduct(Vec3(x, y, z)));
    }
  }
  add_rectangle(mesh, 0, 2, 3, 1);  // below
  add_rectangle(mesh, 4, 5, 7, 6);  // above
  add_rectangle(mesh, 0, 1, 5, 4);  // south
  add_rectangle(mesh, 2, 6, 7, 3);  // north
  add_rectangle(mesh, 0, 4, 6, 2);  // west
  add_rectangle(mesh, 1, 3, 7, 5);  // east
  return {mesh, {}};
}

Surface surface_of(const Cylinder& cylinder, double sagitta_m) {
  require(cylinder.diameter_m > 0.0 && cylinder.length_m > 0.0, "cylinder: its diameter or length is not above 0 m");
  const double radius_m = 0.5 * cylinder.diameter_m, half_m = 0.5 * cylinder.length_m;
  const double half_step_rad = std::acos(std::max(0.5, 1.0 - sagitta_m / radius_m));
  const double wanted = std::ceil(std::numbers::pi / half_step_rad);
  require_few(4.0 * wanted);
  const auto sides = static_cast<std::uint32_t>(std::max<double>(kFewestSides, wanted));
  TriangleMesh mesh;
  for (const double y : {-half_m, half_m}) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / sides;
      add(mesh, {radius_m * std::cos(turn), y, radius_m * std::sin(turn)});
    }
  }
  const std::uint32_t south = add(mesh, {0.0, -half_m, 0.0}), north = add(mesh, {0.0, half_m, 0.0});
  const double side_rad = 2.0 * std::numbers::pi / sides;
  const auto round_m = static_cast<float>(0.25 * radius_m * (1.0 - std::cos(side_rad)));  // of an edge, or a diagonal
  Surface surface;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t next = (i + 1) % sides;
    add_rectangle(mesh, i, sides + i, sides + next, next);
    surface.bulge_m.insert(surface.bulge_m.end(), {{0.0F, round_m, round_m}, {round_m, 0.0F, round_m}});
    mesh.triangle.push_back({south, i, next});
    mesh.triangle.push_back({north, sides + next, sides + i});
    surface.bulge_m.insert(surface.bulge_m.end(), 2, {0.0F, 0.0F, 0.0F});
  }
  surface.mesh = std::move(mesh);
  return surface;
}

Surface surface_of(const Plate& plate, double) {
  require((plate.size_m.array() > 0.0).all(), "plate: a side is not above 0 m");
  TriangleMesh mesh;
  const Vec3 half(0.5 * plate.size_m.x(), 0.5 * plate.size_m.y(), 0.0);
  for (const auto& [x, y] : {std::pair(-1.0, -1.0), {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
    add(mesh, half.cwiseProduct(Vec3(x, y, 0.0)));
  add_rectangle(mesh, 0, 1, 2, 3);
  return {mesh, {}};
}

Surface surface_of(const Cone& cone, double sagitta_m) {
  require(cone.diameter_m > 0.0 && cone.height_m > 0.0 && cone.top_diameter_m >= 0.0,
          "cone: its diameter or height is not above 0 m");
  const double half_m = 0.5 * cone.height_m, top_m = 0.5 * cone.top_diameter_m;
  Outline outline(Vec2(0.0, -half_m));
  outline.straight_to({0.5 * cone.diameter_m, -half_m}).straight_to({top_m, half_m});
  if (top_m > 0.0) outline.straight_to({0.0, half_m});
  return turned(outline, sagitta_m);
}

Surface surface_of(const Tyre& tyre, double sagitta_m) {
  require(tyre.width_m > 0.0 && tyre.diameter_m > 2.0 * tyre.width_m,
          "tyre: its diameter is not above twice its width");
  const double tube_m = 0.5 * tyre.width_m, ring_m = 0.5 * tyre.diameter_m - tube_m;
  Outline outline(Vec2(ring_m + tube_m, 0.0));
  outline.arc({ring_m, 0.0}, 2.0 * std::numbers::pi, sagitta_m).close();
  return turned(outline, sagitta_m);
}

Surface surface_of(const Pipe& pipe, double sagitta_m) {
  const double outer_m = 0.5 * pipe.diameter_m, inner_m = outer_m - pipe.wall_m, half_m = 0.5 * pipe.length_m;
  require(pipe.wall_m > 0.0 && inner_m > 0.0 && half_m > 0.0,
          "pipe: its wall leaves no bore, or its length is not above 0 m");
  Outline outline(Vec2(outer_m, -half_m));
  outline.straight_to({outer_m, half_m}).straight_to({inner_m, half_m}).straight_to({inner_m, -half_m}).close();
  return laid_down(turned(outline, sagitta_m));
}

/// Half of its length is body, a fifth shoulder, and the rest a neck of a third of its diameter.
Surface surface_of(const Bottle& bottle, double sagitta_m) {
  require(bottle.diameter_m > 0.0 && bottle.length_m > 0.0, "bottle: its diameter or length is not above 0 m");
  const double body_m = 0.5 * bottle.diameter_m, neck_m = body_m / 3.0, half_m = 0.5 * bottle.length_m;
  Outline outline(Vec2(0.0, -half_m));
  outline.straight_to({body_m, -half_m}).straight_to({body_m, 0.0}).straight_to({neck_m, 0.4 * half_m});
  outline.straight_to({neck_m, half_m}).straight_to({0.0, half_m});
  return laid_down(turned(outline, sagitta_m));
}

/// The nose is as long as 1.5 diameters, or 0.4 of the length if that is less; a seventh of the length is tail.
Surface surface_of(const Shell& shell, double sagitta_m) {
  require(shell.diameter_m > 0.0 && shell.length_m > 0.0, "shell: its diameter or length is not above 0 m");
  const double body_m = 0.5 * shell.diameter_m, half_m = 0.5 * shell.length_m;
  const double nose_m = std::min(1.5 * shell.diameter_m, 0.4 * shell.length_m);
  require(nose_m > body_m, "shell: its length is not above 1.25 diameters");
  const double round_m = (body_m * body_m + nose_m * nose_m) / (2.0 * body_m);  // of the ogive
  Outline outline(Vec2(0.0, -half_m));
  outline.straight_to({0.8 * body_m, -half_m}).straight_to({body_m, -half_m + shell.length_m / 7.0});
  outline.straight_to({body_m, half_m - nose_m});
  outline.arc({body_m - round_m, half_m - nose_m}, std::asin(nose_m / round_m), sagitta_m).end_at({0.0, half_m});
  return laid_down(turned(outline, sagitta_m));
}

Surface surface_of(const Wedge& wedge, double) {
  require((wedge.size_m.array() > 0.0).all(), "wedge: a side is not above 0 m");
  TriangleMesh mesh;
  for (const auto& [y, z] : {std::pair(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}}) {
    for (const double x : {-0.5, 0.5}) add(mesh, wedge.size_m.cwiseProduct(Vec3(x, y, z)));
  }
  add_rectangle(mesh, 0, 2, 3, 1);     // below
  add_rectangle(mesh, 2, 4, 5, 3);     // north
  add_rectangle(mesh, 0, 1, 5, 4);     // the ramp
  mesh.triangle.push_back({0, 4, 2});  // west
  mesh.triangle.push_back({1, 3, 5});  // east
  return {mesh, {}};
}

Surface surface_of(const Cable& cable, double sagitta_m) {
  return rope_along(catenary(cable.length_m, cable.sag_m, sagitta_m), cable.diameter_m, sagitta_m);
}

Surface surface_of(const Chain& chain, double sagitta_m) {
  return chain_along(catenary(chain.length_m, chain.sag_m, sagitta_m), chain.wire_m, sagitta_m);
}

/// Adds a part of a whole, where it stands.
void add(Surface& whole, const Surface& part, const Eigen::Isometry3d& pose) {
  const auto first = static_cast<std::uint32_t>(whole.mesh.vertex_m.size());
  for (const Eigen::Vector3f& vertex : part.mesh.vertex_m) add(whole.mesh, pose * vertex.cast<double>());
  for (const auto& [a, b, c] : part.mesh.triangle) whole.mesh.triangle.push_back({first + a, first + b, first + c});
  whole.bulge_m.insert(whole.bulge_m.end(), part.bulge_m.begin(), part.bulge_m.end());
  whole.bulge_m.resize(whole.mesh.triangle.size());  // of flat parts: none
}

Surface surface_of(const Figure& figure, double sagitta_m) {
  require((figure.size_m.array() > 0.0).all(), "object: a size is not above 0 m");
  Surface whole;
  for (const Part& part : parts_of(figure)) add(whole, ensonify::solids::surface_of(part.solid, sagitta_m), part.pose);
  return whole;
}

Surface surface_of(const Mesh& mesh, double) {
  require(mesh.triangles != nullptr && mesh.scale > 0.0, "mesh: has no triangles, or its scale is not above 0");
  TriangleMesh scaled = *mesh.triangles;
  for (Eigen::Vector3f& vertex : scaled.vertex_m) vertex *= static_cast<float>(mesh.scale);
  return {std::move(scaled), {}};
}

double radius_m(const Sphere& sphere) { return 0.5 * sphere.diameter_m; }
double radius_m(const Box& box) { return 0.5 * box.size_m.norm(); }
double radius_m(const Cylinder& cylinder) { return 0.5 * std::hypot(cylinder.diameter_m, cylinder.length_m); }
double radius_m(const Plate& plate) { return 0.5 * plate.size_m.norm(); }
double radius_m(const Cone& cone) {
  return 0.5 * std::hypot(std::max(cone.diameter_m, cone.top_diameter_m), cone.height_m);
}
double radius_m(const Tyre& tyre) { return 0.5 * tyre.diameter_m; }
double radius_m(const Pipe& pipe) { return 0.5 * std::hypot(pipe.diameter_m, pipe.length_m); }
double radius_m(const Bottle& bottle) { return 0.5 * std::hypot(bottle.diameter_m, bottle.length_m); }
double radius_m(const Shell& shell) { return 0.5 * std::hypot(shell.diameter_m, shell.length_m); }
double radius_m(const Wedge& wedge) { return 0.5 * wedge.size_m.norm(); }
double radius_m(const Cable& cable) { return 0.5 * (std::hypot(cable.length_m, cable.sag_m) + cable.diameter_m); }
double radius_m(const Chain& chain) { return 0.5 * std::hypot(chain.length_m, chain.sag_m) + 3.6 * chain.wire_m; }
double radius_m(const Figure& figure) { return 0.5 * figure.size_m.norm(); }
double radius_m(const Mesh& mesh) {
  float radius2_m2 = 0.0F;
  for (const Eigen::Vector3f& vertex : mesh.triangles->vertex_m)
    radius2_m2 = std::max(radius2_m2, vertex.squaredNorm());
  return mesh.scale * std::sqrt(static_cast<double>(radius2_m2));
}

/// Integral of (z - height) over the part of a triangle that lies below the height, times its normal's z.
double moment_below(const std::array<Vec3, 3>& corners, double height_m) {
  std::array<Vec3, 4> below;  // what is left of the triangle
  std::size_t count = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3 &a = corners[c], &b = corners[(c + 1) % 3];
    const double from = a.z() - height_m, to = b.z() - height_m;
    if (from <= 0.0) below[count++] = a;
    if ((from < 0.0 && to > 0.0) || (from > 0.0 && to < 0.0)) below[count++] = a + from / (from - to) * (b - a);
  }
  double sum = 0.0;
  for (std::size_t c = 2; c < count; ++c) {
    const double area_z = 0.5 * (below[c - 1] - below[0]).cross(below[c] - below[0]).z();
    sum += area_z * ((below[0].z() + below[c - 1].z() + below[c].z()) / 3.0 - height_m);
  }
  return sum;
}

}  // namespace

bool is_closed(const Solid& solid) {
  if (const auto* mesh = std::get_if<Mesh>(&solid)) return mesh->closed;
  return !std::holds_alternative<Plate>(solid);
}

double radius_m(const Solid& solid) {
  return std::visit([](const auto& one) { return radius_m(one); }, solid);
}

Surface surface_of(const Solid& solid, double sagitta_m) {
  require(sagitta_m > 0.0, "solid: the sagitta is not above 0 m");
  return std::visit([&](const auto& one) { return surface_of(one, sagitta_m); }, solid);
}

double volume_below_m3(const TriangleMesh& mesh, double height_m) {
  double volume_m3 = 0.0;
  for (const auto& [a, b, c] : mesh.triangle) {
    volume_m3 += moment_below(
        {mesh.origin_enu_m + mesh.vertex_m[a].cast<double>(), mesh.origin_enu_m + mesh.vertex_m[b].cast<double>(),
         mesh.origin_enu_m + mesh.vertex_m[c].cast<double>()},
        height_m);
  }
  return volume_m3;
}

double height_of_share_m(const TriangleMesh& mesh, double share) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& corners : mesh.triangle) {
    for (const std::uint32_t corner : corners) {
      const double z = mesh.origin_enu_m.z() + static_cast<double>(mesh.vertex_m[corner].z());
      low = std::min(low, z), high = std::max(high, z);
    }
  }
  const double whole_m3 = volume_below_m3(mesh, high), step_m = 1e-6 * (high - low);
  if (!(whole_m3 > 1e-12)) return low + share * (high - low);
  while (high - low > step_m) {
    const double middle = 0.5 * (low + high);
    (volume_below_m3(mesh, middle) < share * whole_m3 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace ensonify::solids
