#include "kernels/mesh/solids/lathe.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/mesh/solids/facet.h"
#include "kernels/mesh/solids/testing/closed.h"

using namespace ensonify;
using namespace ensonify::solids;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using frames::Vec2;
using frames::Vec3;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFine_m = 1e-5;

/// The greatest distance of the middles of edges, as they bulge, from a surface.
template <class Distance>
double off_m(const Surface& surface, const Distance& distance_m) {
  double worst_m = 0.0;
  for (std::size_t t = 0; t < surface.mesh.triangle.size(); ++t) {
    const Facet facet = facet_of(surface, t);
    for (std::size_t c = 0; c < 3; ++c) worst_m = std::max(worst_m, std::abs(distance_m(middle_of_edge(facet, c))));
  }
  return worst_m;
}

}  // namespace

TEST_CASE("bodies of revolution close, and have the volume of their closed forms") {
  const auto holds = [](const Solid& solid, double volume) {
    const Surface surface = surface_of(solid, kFine_m);
    CHECK(closes(surface.mesh));
    CHECK(surface.bulge_m.size() == surface.mesh.triangle.size());
    CHECK_THAT(volume_m3(surface.mesh), WithinRel(volume, 1e-3));
  };
  holds(Cone{0.6, 0.0, 0.9}, kPi * 0.09 * 0.9 / 3.0);
  holds(Cone{0.6, 0.2, 0.5}, kPi * 0.5 / 3.0 * (0.09 + 0.03 + 0.01));
  holds(Cone{0.2, 0.6, 0.5}, kPi * 0.5 / 3.0 * (0.09 + 0.03 + 0.01));  // upside down
  holds(Tyre{0.7, 0.2}, 2.0 * kPi * kPi * 0.25 * 0.01);
  holds(Pipe{0.5, 3.0, 0.05}, kPi * 3.0 * (0.0625 - 0.04));
  // A body of half the length, a shoulder of a fifth, a neck of 0.3.
  holds(Bottle{0.09, 0.3}, kPi * 0.045 * 0.045 * (0.15 + 0.06 / 3.0 * (1.0 + 1.0 / 3.0 + 1.0 / 9.0) + 0.09 / 9.0));
}

TEST_CASE("the nose of a shell is a tangent ogive") {
  // Its volume is pi times the integral of (sqrt(rho^2 - z^2) + R - rho)^2 over the nose, here by Simpson's rule.
  const double r = 0.1, nose = 0.3, rho = (r * r + nose * nose) / (2.0 * r);
  double ogive = 0.0;
  constexpr int kSteps = 1000;
  for (int i = 0; i <= kSteps; ++i) {
    const double z = nose * i / kSteps, radius = std::sqrt(rho * rho - z * z) + r - rho;
    ogive += (i == 0 || i == kSteps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * radius * radius;
  }
  ogive *= kPi * nose / kSteps / 3.0;
  const double tail = kPi / 7.0 / 3.0 * r * r * (1.0 + 0.8 + 0.64), body = kPi * r * r * (1.0 - nose - 1.0 / 7.0);
  const Surface shell = surface_of(Shell{0.2, 1.0}, kFine_m);
  CHECK(closes(shell.mesh));
  CHECK_THAT(volume_m3(shell.mesh), WithinRel(ogive + body + tail, 1e-3));
  CHECK_THAT(box_of(shell.mesh).max().y(), WithinAbs(0.5, 1e-6));  // the tip, to the north
}

TEST_CASE("curved triangles bulge onto bodies of revolution") {
  const double sagitta_m = 1e-3;
  CHECK(off_m(surface_of(Tyre{0.7, 0.2}, sagitta_m),
              [](const Vec3& at) { return std::hypot(std::hypot(at.x(), at.y()) - 0.25, at.z()) - 0.1; }) < 5e-5);
  CHECK(off_m(surface_of(Cone{0.6, 0.2, 0.5}, sagitta_m), [](const Vec3& at) {
          if (std::abs(std::abs(at.z()) - 0.25) < 1e-7) return 0.0;  // on an end
          return std::hypot(at.x(), at.y()) - (0.2 - 0.4 * at.z());
        }) < 2e-4);  // across a taper of 3 to 1 a diagonal's bulge is off by a sixth
}

TEST_CASE("no triangle leaves a tyre by more than the sagitta") {
  const double sagitta_m = 2e-3;
  const auto mesh = surface_of(Tyre{0.7, 0.2}, sagitta_m).mesh;
  for (const auto& [a, b, c] : mesh.triangle) {
    const Vec3 at = (mesh.vertex_m[a] + mesh.vertex_m[b] + mesh.vertex_m[c]).cast<double>() / 3.0;
    const double off = std::hypot(std::hypot(at.x(), at.y()) - 0.25, at.z()) - 0.1;
    CHECK(std::abs(off) <= 2.0 * sagitta_m);  // round the tube and round the ring
  }
}

TEST_CASE("bodies of revolution without a size are refused") {
  CHECK_THROWS_WITH(surface_of(Cone{0, 0, 1}, 1e-3), "cone: its diameter or height is not above 0 m");
  CHECK_THROWS_WITH(surface_of(Tyre{0.4, 0.2}, 1e-3), "tyre: its diameter is not above twice its width");
  CHECK_THROWS_WITH(surface_of(Pipe{0.1, 1, 0.05}, 1e-3),
                    "pipe: its wall leaves no bore, or its length is not above 0 m");
  CHECK_THROWS_WITH(surface_of(Bottle{0.1, 0}, 1e-3), "bottle: its diameter or length is not above 0 m");
  CHECK_THROWS_WITH(surface_of(Shell{0.2, 0.2}, 1e-3), "shell: its length is not above 1.25 diameters");
  CHECK_THROWS_AS(surface_of(Tyre{100, 10}, 1e-7), std::invalid_argument);
}
