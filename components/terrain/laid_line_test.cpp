#include "components/terrain/laid_line.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "components/config/config_error.h"
#include "components/terrain/object_meshes.h"
#include "components/terrain/placed_object.h"

using namespace ensonify;
using namespace ensonify::source;
using Catch::WithinAbs;
using frames::Vec2;
using frames::Vec3;

namespace {

/// Ground of a closed form on posts 0.1 m apart, 100 m each way.
class Ground : public TerrainSource {
 public:
  explicit Ground(std::function<double(const Vec2&)> height) : height_(std::move(height)) {}
  Extent extent() const override { return {-50, -50, 50, 50}; }
  double lowest_m() const override { return -20; }
  double highest_m() const override { return -5; }
  frames::Geodetic origin() const override { return {}; }
  double native_spacing_m() const override { return 0.1; }
  void sample(const PostBlock&, std::span<float>, std::span<std::uint8_t>) const override { FAIL("not asked"); }
  double height_m(const Vec2& place) const override { return height_(place); }

 private:
  std::function<double(const Vec2&)> height_;
};

std::vector<SceneObject> sections(const solids::Solid& solid, std::vector<Vec2> through, double taut_m = 0.0,
                                  double buried = 0.0) {
  const auto route = std::make_shared<const LaidRoute>(LaidRoute{std::move(through), taut_m, buried});
  std::vector<SceneObject> all;
  for (int i = 0; i < 4; ++i) {
    SceneObject& one = all.emplace_back();
    one.name = "wire_" + std::to_string(i + 1);
    one.solid = solid;
    one.laid = LaidSection{route, 5.0 * i, 5.0 * (i + 1)};
    one.place.position_enu_m.head<2>() = position_on(*route, 5.0 * i + 2.5);
  }
  return all;
}

double waves(const Vec2& place) { return -10.0 + 0.3 * std::sin(2.0 * place.x()); }

}  // namespace

TEST_CASE("a limp cable follows the seabed within 2 cm, section joined to section") {
  const Ground ground(waves);
  ObjectMeshes meshes;
  double west_m = -1.0;
  for (const SceneObject& section : sections(solids::Cable{0.1}, {{0, 0}, {20, 0}})) {
    const PlacedObject placed = placed_object(section, meshes, ground);
    CHECK(placed.message.shape == "cable");
    CHECK(placed.message.mesh >= 0);
    double first_m = 1e9, last_m = -1e9, lowest_m = 1e9, highest_m = -1e9;
    for (const auto& vertex : placed.surface.mesh.vertex_m) {
      const Vec3 at = placed.surface.mesh.origin_enu_m + vertex.cast<double>();
      first_m = std::min(first_m, at.x()), last_m = std::max(last_m, at.x());
      // Its surface is within its radius of a line that lies by a radius above the ground, measured across a slope
      // of up to 0.6.
      const double above_m = at.z() - waves({at.x(), at.y()});
      lowest_m = std::min(lowest_m, above_m), highest_m = std::max(highest_m, above_m);
      CHECK(std::abs(at.y()) < 0.0501);
    }
    CHECK(lowest_m > -0.02);
    CHECK(lowest_m < 0.02);
    CHECK(highest_m < 0.1 + 0.02);
    if (west_m >= 0.0) CHECK_THAT(first_m, WithinAbs(west_m, 0.06));
    west_m = last_m;
  }
  CHECK_THAT(west_m, WithinAbs(20.0, 0.06));
}

TEST_CASE("a taut cable spans from crest to crest, and half of a buried one is in the seabed") {
  const Ground ground(waves);
  ObjectMeshes meshes;
  for (const SceneObject& section : sections(solids::Cable{0.1}, {{0, 0}, {20, 0}}, 1000.0)) {
    const PlacedObject placed = placed_object(section, meshes, ground);
    // Crests are 3.14 m apart: it hangs by 1 mm there; only its ends, beyond the last crest, are lower.
    if (section.laid->from_m > 1.0 && section.laid->to_m < 18.0) CHECK(placed.box_enu_m.min().z() > -9.72);
  }
  ObjectMeshes others;
  const PlacedObject half = placed_object(sections(solids::Cable{0.1}, {{0, 0}, {20, 0}}, 0.0, 0.5)[1], others,
                                          Ground([](const Vec2&) { return -10.0; }));
  CHECK_THAT(half.box_enu_m.max().z(), WithinAbs(-9.95, 1e-3));
  CHECK_THAT(half.message.buried, WithinAbs(0.5, 0.01));
}

TEST_CASE("a laid chain lies on the ground with links side by side") {
  ObjectMeshes meshes;
  const PlacedObject placed = placed_object(sections(solids::Chain{0.05}, {{0, 0}, {0, 20}})[0], meshes,
                                            Ground([](const Vec2&) { return -8.0; }));
  CHECK_THAT(placed.box_enu_m.min().z(), WithinAbs(-8.0, 0.03));
  CHECK(placed.surface.mesh.triangle.size() > 1000);
}

TEST_CASE("a line that leaves the terrain or crosses a hole is refused with its place") {
  ObjectMeshes meshes;
  CHECK_THROWS_WITH(placed_object(sections(solids::Cable{0.1}, {{40, 0}, {60, 0}})[0], meshes, Ground(waves)),
                    Catch::Contains("objects.wire_1.laid.through_m: leaves the terrain at (50."));
  const Ground hole([](const Vec2& at) { return at.x() > 4 && at.x() < 5 ? std::nan("") : -10.0; });
  CHECK_THROWS_WITH(placed_object(sections(solids::Cable{0.1}, {{0, 0}, {20, 0}})[0], meshes, hole),
                    Catch::Contains("crosses a hole of the terrain at (4."));
}
