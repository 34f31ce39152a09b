#include "kernels/mesh/progressive/cut.h"

#include <catch2/catch.hpp>
#include <map>

#include "kernels/mesh/progressive/testing/meshes.h"

using namespace ensonify;
using namespace ensonify::progressive;

namespace {

Hierarchy made_of(const TriangleMesh& mesh) { return hierarchy_of(mesh, collapses_of(mesh)); }

frames::Vec3 middle_of(const TriangleMesh& mesh, const Triangle& t) {
  return mesh.origin_enu_m + (mesh.vertex_m[t[0]] + mesh.vertex_m[t[1]] + mesh.vertex_m[t[2]]).cast<double>() / 3.0;
}

/// Heads above the quay, pointing down its wall, and from the water towards it.
std::vector<View> views_of_quay(double x) {
  View side = fan({x, -12.0, -2.0}, 0.0, 0.0, 30.0);
  side.frustum.axis_enu = frames::Vec3::UnitX();  // across the wall, from foot to deck
  side.frustum.side_enu = frames::Vec3::UnitZ();
  side.frustum.zero_enu = frames::Vec3::UnitY();
  return {fan({x - 15.0, -3.0, 4.0}, 0.3, 0.0, 20.0), side};
}

}  // namespace

TEST_CASE("everything in view is the source, nothing in view the coarsest") {
  const Hierarchy quay = made_of(quay_wall(6.0));
  Cut cut(quay);
  View all = fan({0.0, 0.0, 30.0}, 0.0, 0.0, 1e4);
  all.frustum.low_sine = -1.0;
  all.frustum.high_sine = 1.0;
  all.frustum.low_angle_rad = -std::numbers::pi;
  all.frustum.high_angle_rad = std::numbers::pi;
  cut.choose(quay, std::vector<View>{all});
  CHECK(std::vector<Triangle>(cut.triangles().begin(), cut.triangles().end()) == quay.mesh.triangle);
  cut.choose(quay, {});
  CHECK(cut.triangles().size() == quay.coarsest.size());
}

TEST_CASE("a main lobe's view intersects the source's triangles and nothing else") {
  const Hierarchy quay = made_of(quay_wall(40.0));
  Cut cut(quay);
  for (const double x : {-8.0, 0.0, 11.0}) {
    const auto views = views_of_quay(x);
    cut.choose(quay, views);
    std::size_t in_view = 0, lost = 0, foreign = 0;
    std::map<std::uint32_t, Triangle> shown;
    for (std::size_t i = 0; i < cut.triangles().size(); ++i) shown[cut.sources()[i]] = cut.triangles()[i];
    for (const View& view : views) {
      for (std::uint32_t t = 0; t < quay.mesh.triangle.size(); ++t) {
        if (!lod::intersects(view.frustum, {middle_of(quay.mesh, quay.mesh.triangle[t]), 0.0})) continue;
        ++in_view;
        const auto own = shown.find(t);
        if (own == shown.end() || own->second != quay.mesh.triangle[t]) ++lost;
      }
      for (const auto& [source, triangle] : shown) {
        if (triangle != quay.mesh.triangle[source] &&
            lod::intersects(view.frustum, {middle_of(quay.mesh, triangle), 0.0}))
          ++foreign;
      }
    }
    CHECK(lost == 0);
    CHECK(foreign == 0);
    CHECK(in_view > 200);
    CHECK(cut.triangles().size() - in_view < (quay.mesh.triangle.size() - in_view) / 8);
  }
}

TEST_CASE("no cut has a crack: each edge of a closed surface is used equally both ways") {
  const Hierarchy ball = made_of(bumpy_ball(80, 40));
  Cut cut(ball);
  for (int n = 0; n < 12; ++n) {
    const random::Stream draw{3, "cracks"};
    const auto k = static_cast<std::uint64_t>(n);
    const frames::Vec3 place(20.0 * draw.uniform(k, 0) - 10.0, 20.0 * draw.uniform(k, 1) - 10.0, 15.0);
    cut.choose(ball, std::vector<View>{fan(place, 6.0 * draw.uniform(k, 2), n % 3 == 0 ? 0.0 : 0.05 * n, 30.0)});
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& [a, b, c] : cut.triangles()) {
      for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) {
        REQUIRE(from != to);
        edges[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
      }
    }
    for (const auto& [edge, passed] : edges) REQUIRE(passed == 0);
    CHECK(cut.triangles().size() >= 4);
  }
}

TEST_CASE("the mesh of a ping is a function of its views, however it was reached") {
  const Hierarchy quay = made_of(quay_wall(20.0));
  Cut wandering(quay);
  for (const double x : {-6.0, 3.0, 5.0, 0.0}) wandering.choose(quay, views_of_quay(x));
  Cut fresh(quay);
  fresh.choose(quay, views_of_quay(0.0));
  CHECK(std::equal(fresh.triangles().begin(), fresh.triangles().end(), wandering.triangles().begin(),
                   wandering.triangles().end()));
}

TEST_CASE("a tolerance holds within a view") {
  const Hierarchy ball = made_of(bumpy_ball(80, 40));
  Cut cut(ball);
  std::size_t finer = ball.mesh.triangle.size() + 1;
  for (const double tolerance_m : {0.02, 0.1, 0.4}) {
    View all = fan({0.0, 0.0, 0.0}, 0.0, tolerance_m, 50.0);
    all.frustum.low_sine = -1.0;
    all.frustum.high_sine = 1.0;
    all.frustum.low_angle_rad = -std::numbers::pi;
    all.frustum.high_angle_rad = std::numbers::pi;
    cut.choose(ball, std::vector<View>{all});
    CHECK(cut.triangles().size() < finer);
    finer = cut.triangles().size();
    // What is held is where vertices were; between them the surface may be as far off again, and the ball's facets,
    // 0.8 m long, leave it by 0.03 m.
    double worst_m = 0.0;
    for (const auto& [a, b, c] : cut.triangles()) {
      const Eigen::Vector3d middle =
          (ball.mesh.vertex_m[a] + ball.mesh.vertex_m[b] + ball.mesh.vertex_m[c]).cast<double>() / 3.0;
      const double polar = std::acos(middle.z() / middle.norm()), azimuth = std::atan2(middle.y(), middle.x());
      worst_m =
          std::max(worst_m, std::abs(middle.norm() - 10.0 - 0.5 * std::sin(7.0 * polar) * std::cos(5.0 * azimuth)));
    }
    CHECK(worst_m < 2.0 * tolerance_m + 0.03);
  }
}
