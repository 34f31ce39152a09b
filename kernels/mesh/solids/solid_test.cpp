#include "kernels/mesh/solids/solid.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/mesh/solids/testing/closed.h"

using namespace ensonify;
using namespace ensonify::solids;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using frames::Vec3;
using progressive::TriangleMesh;

namespace {

TriangleMesh sphere(double diameter_m, double sagitta_m) { return surface_of(Sphere{diameter_m}, sagitta_m).mesh; }

}  // namespace

TEST_CASE("a sphere's triangles close, and stay within the sagitta") {
  const double sagitta_m = 3.1e-4;  // a sixteenth of the wave at 300 kHz
  const TriangleMesh mesh = sphere(0.3, sagitta_m);
  CHECK(closes(mesh));
  double nearest_m = 1.0, longest_m = 0.0;
  for (const auto& [a, b, c] : mesh.triangle) {
    const Vec3 p = mesh.vertex_m[a].cast<double>(), q = mesh.vertex_m[b].cast<double>(),
               r = mesh.vertex_m[c].cast<double>();
    CHECK_THAT(p.norm(), WithinAbs(0.15, 1e-7));
    nearest_m = std::min(nearest_m, ((p + q + r) / 3.0).norm());
    longest_m = std::max({longest_m, (q - p).norm(), (r - q).norm(), (p - r).norm()});
    CHECK(p.dot((q - p).cross(r - p)) > 0.0);  // seen from outside
  }
  CHECK(0.15 - nearest_m <= sagitta_m);
  CHECK(longest_m < 0.022);
  CHECK(mesh.triangle.size() < 4000);
  CHECK_THAT(volume_m3(mesh), WithinRel(4.0 / 3.0 * std::numbers::pi * 0.15 * 0.15 * 0.15, 0.005));
}

TEST_CASE("boxes and cylinders close, and have their volume") {
  const TriangleMesh box = surface_of(Box{{1.0, 0.6, 0.5}}, 1e-3).mesh;
  CHECK(closes(box));
  CHECK(box.triangle.size() == 12);
  CHECK_THAT(volume_m3(box), WithinRel(0.3, 1e-6));
  const TriangleMesh cylinder = surface_of(Cylinder{0.5, 2.0}, 1e-4).mesh;
  CHECK(closes(cylinder));
  CHECK_THAT(volume_m3(cylinder), WithinRel(2.0 * std::numbers::pi * 0.0625, 1e-3));
  for (const auto& vertex : cylinder.vertex_m) CHECK(std::abs(vertex.y()) == Approx(1.0));
  const TriangleMesh plate = surface_of(Plate{{0.2, 0.3}}, 1e-3).mesh;
  CHECK(plate.triangle.size() == 2);
  CHECK(volume_below_m3(plate, 0.0) == 0.0);
}

TEST_CASE("curved triangles bulge onto the surface") {
  const auto on_surface = [](const Surface& surface, const auto& distance_m) {
    double worst_m = 0.0;
    for (std::size_t t = 0; t < surface.mesh.triangle.size(); ++t) {
      std::array<Vec3, 3> corner;
      for (std::size_t c = 0; c < 3; ++c) corner[c] = surface.mesh.vertex_m[surface.mesh.triangle[t][c]].cast<double>();
      const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3 middle =
            0.5 * (corner[c] + corner[(c + 1) % 3]) + static_cast<double>(surface.bulge_m[t][c]) * normal;
        worst_m = std::max(worst_m, std::abs(distance_m(middle)));
      }
    }
    return worst_m;
  };
  CHECK(on_surface(surface_of(Sphere{0.3}, 3e-4), [](const Vec3& at) { return at.norm() - 0.15; }) < 3e-6);
  CHECK(on_surface(surface_of(Cylinder{0.5, 2.0}, 3e-4), [](const Vec3& at) {
          const bool on_end = std::abs(std::abs(at.y()) - 1.0) < 1e-9;
          return on_end ? 0.0 : std::hypot(at.x(), at.z()) - 0.25;
        }) < 3e-6);
}

TEST_CASE("the volume below a height is that of a spherical cap") {
  const double a = 0.25, height = 0.1;  // of the cap, from its lowest point
  const TriangleMesh mesh = sphere(2 * a, 1e-4);
  const double cap = std::numbers::pi * height * height * (3 * a - height) / 3.0;
  CHECK_THAT(volume_below_m3(mesh, -a + height), WithinRel(cap, 0.005));
  CHECK(volume_below_m3(mesh, -a - 0.01) == 0.0);
}

TEST_CASE("a share of the volume lies below its height: sphere, tilted cylinder, plate") {
  CHECK_THAT(height_of_share_m(sphere(0.5, 1e-4), 0.5), WithinAbs(0.0, 1e-4));
  // Of a sphere a fifth lies below h with h^2 (3 a - h) = 4/5 a^3.
  const double h = (height_of_share_m(sphere(0.5, 1e-5), 0.2) + 0.25) / 0.25;
  CHECK_THAT(h * h * (3 - h), WithinAbs(0.8, 0.002));
  TriangleMesh leaning = surface_of(Cylinder{0.5, 2.0}, 1e-4).mesh;
  const Eigen::Matrix3f turn = Eigen::AngleAxisf(0.7F, Eigen::Vector3f(1, 0.3F, 0).normalized()).toRotationMatrix();
  for (auto& vertex : leaning.vertex_m) vertex = turn * vertex;
  CHECK_THAT(height_of_share_m(leaning, 0.5), WithinAbs(0.0, 1e-4));  // by symmetry
  const double z = height_of_share_m(leaning, 0.3);
  CHECK_THAT(volume_below_m3(leaning, z) / volume_m3(leaning), WithinAbs(0.3, 1e-4));
  CHECK_THAT(height_of_share_m(surface_of(Plate{{1, 1}}, 1e-3).mesh, 0.5), WithinAbs(0.0, 1e-12));
}

TEST_CASE("solids without a size, and ones of too many triangles, are refused") {
  CHECK_THROWS_WITH(surface_of(Sphere{0.0}, 1e-3), "sphere: its diameter is not above 0 m");
  CHECK_THROWS_WITH(surface_of(Box{{1, 0, 1}}, 1e-3), "box: a side is not above 0 m");
  CHECK_THROWS_WITH(surface_of(Cylinder{1, 0}, 1e-3), "cylinder: its diameter or length is not above 0 m");
  CHECK_THROWS_WITH(surface_of(Plate{{1, -1}}, 1e-3), "plate: a side is not above 0 m");
  CHECK_THROWS_WITH(surface_of(Sphere{1.0}, 0.0), "solid: the sagitta is not above 0 m");
  CHECK_THROWS_AS(surface_of(Sphere{1e3}, 1e-5), std::invalid_argument);
}
