#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/mesh/progressive/hierarchy.h"
#include "kernels/mesh/progressive/objects.h"

using namespace ensonify::progressive;
using ensonify::frames::Vec3;

namespace {

/// By the divergence theorem: positive when all triangles face outwards.
double volume_m3(const TriangleMesh& mesh) {
  double sum = 0.0;
  const auto at = [&](std::uint32_t vertex) { return mesh.vertex_m[vertex].cast<double>().eval(); };
  for (const auto& [a, b, c] : mesh.triangle) sum += at(a).dot(at(b).cross(at(c))) / 6.0;
  return sum;
}

Eigen::AlignedBox3f box_of(const TriangleMesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const auto& vertex : mesh.vertex_m) box.extend(vertex);
  return box;
}

const Bar kFender{.from_m = {2, 1, -4}, .to_m = {2, 1, 0}, .section_m = {0.3, 0.4}};
const Bar kRung{.from_m = {0, 0, -1}, .to_m = {0, 5, 2}, .diameter_m = 0.5};

}  // namespace

TEST_CASE("a bar is closed and has the volume of its section times its length") {
  // Floats of some metres: 1e-6 of a coordinate, and 1e-5 of a thin bar's volume.
  CHECK(volume_m3(mesh_of(std::vector{kFender})) == Approx(0.3 * 0.4 * 4).epsilon(1e-5));
  const double polygon_m2 = 0.5 * Bar::kSides * 0.25 * 0.25 * std::sin(2 * std::numbers::pi / Bar::kSides);
  CHECK(volume_m3(mesh_of(std::vector{kRung})) == Approx(polygon_m2 * std::sqrt(34.0)).epsilon(1e-5));
}

TEST_CASE("its first width is level, along x where it stands upright") {
  CHECK(box_of(mesh_of(std::vector{kFender})).sizes().isApprox(Eigen::Vector3f(0.3F, 0.4F, 4.0F), 1e-6F));
  const Bar step{.from_m = {0, 0, 0}, .to_m = {0, 2, 0}, .section_m = {0.3, 0.18}};  // along y: 0.3 m in x, 0.18 m high
  CHECK(box_of(mesh_of(std::vector{step})).sizes().isApprox(Eigen::Vector3f(0.3F, 2.0F, 0.18F), 1e-6F));
}

TEST_CASE("a bar is repeated in rows and grids") {
  Bar pile{.from_m = {0, 0, -10}, .to_m = {0, 0, 0}, .diameter_m = 0.6};
  pile.repeat = {{.count = 4, .step_m = {0, 5, 0}}, {.count = 2, .step_m = {3, 0, 0}}};
  const std::vector bars = {pile, kFender};
  const TriangleMesh mesh = mesh_of(bars);
  CHECK(fault_of(mesh).empty());
  CHECK(static_cast<double>(mesh.vertex_m.size()) == vertices_of(bars));
  CHECK(mesh.vertex_m.size() == 8 * (6 * 16 + 2) + (3 * 4 + 2));
  const auto piles = mesh_of(std::vector{pile});
  CHECK(box_of(piles).sizes().isApprox(Eigen::Vector3f(3.6F, 15.6F, 10.0F), 1e-6F));
  CHECK(volume_m3(piles) ==
        Approx(8 * volume_m3(mesh_of(std::vector{Bar{.from_m = {0, 0, -10}, .to_m = {0, 0, 0}, .diameter_m = 0.6}})))
            .epsilon(1e-5));
}

TEST_CASE("what is flat along a bar is given up, its ends are not") {
  const TriangleMesh mesh = mesh_of(std::vector{kFender});
  const Hierarchy hierarchy = hierarchy_of(mesh, collapses_of(mesh));
  std::size_t flat = 0;  // the ring between the ends, and the middles of these
  for (const Split& split : hierarchy.splits) flat += split.deviation_m < 1e-5F ? 1U : 0U;
  CHECK(flat == 4 + 2);
}

TEST_CASE("what is no bar is refused") {
  const auto made = [](const Bar& bar) { return mesh_of(std::vector{bar}); };
  Bar bar = kFender;
  bar.to_m = bar.from_m;
  CHECK_THROWS_WITH(made(bar), "bar: its ends are at one place");
  bar = kFender;
  bar.section_m.x() = 0.0;
  CHECK_THROWS_WITH(made(bar), "bar: has no section; allowed is a diameter or two widths above 0 m");
  bar = kFender;
  bar.repeat = {{.count = 0}};
  CHECK_THROWS_WITH(made(bar), "bar: is repeated less than once");
}
