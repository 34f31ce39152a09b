#include "kernels/mesh/solids/figure.h"

#include <catch2/catch.hpp>

#include "kernels/mesh/solids/testing/closed.h"

using namespace ensonify;
using namespace ensonify::solids;
using frames::Vec3;

namespace {

struct Known {
  Figure::Kind kind;
  Vec3 size_m;
  std::size_t parts;
};

const std::vector<Known> kFigures{
    {Figure::Kind::kLadder, {0.5, 3.0, 0.06}, 12},  {Figure::Kind::kTrap, {0.6, 0.9, 0.4}, 20},
    {Figure::Kind::kAnchor, {0.8, 1.2, 0.5}, 5},    {Figure::Kind::kMooring, {1.0, 1.0, 6.0}, 3},
    {Figure::Kind::kPerson, {0.5, 1.8, 0.25}, 7},   {Figure::Kind::kBoat, {2.0, 6.0, 2.0}, 4},
    {Figure::Kind::kAircraft, {12.0, 9.0, 3.0}, 4}, {Figure::Kind::kPropeller, {1.0, 0.3, 1.0}, 5},
    {Figure::Kind::kNet, {1.0, 0.3, 1.0}, 272},     {Figure::Kind::kHook, {0.5, 0.12, 1.0}, 12},
    {Figure::Kind::kValve, {0.5, 0.7, 1.0}, 7},     {Figure::Kind::kSheetPiles, {6.0, 0.4, 3.0}, 36},
    {Figure::Kind::kWreck, {10.0, 30.0, 6.0}, 14},  {Figure::Kind::kBrokenAircraft, {12.0, 9.0, 3.0}, 6}};

}  // namespace

TEST_CASE("figures are as large as they are said to be, and all of their parts close") {
  for (const Known& known : kFigures) {
    CAPTURE(static_cast<int>(known.kind));
    const Figure figure{known.kind, known.size_m};
    const auto parts = parts_of(figure);
    CHECK(parts.size() == known.parts);
    for (const Part& part : parts) {
      CHECK(closes(surface_of(part.solid, 1e-3).mesh));
      CHECK(part.pose.linear().determinant() == Approx(1.0));
    }
    const Surface whole = surface_of(Solid{figure}, 1e-3);
    CHECK(closes(whole.mesh));
    CHECK(whole.bulge_m.size() == whole.mesh.triangle.size());
    const auto box = box_of(whole.mesh);
    for (int axis = 0; axis < 3; ++axis) {
      CAPTURE(axis, box.min()[axis], box.max()[axis]);
      CHECK(box.sizes()[axis] <= 1.01 * known.size_m[axis]);
      CHECK(box.sizes()[axis] >= 0.85 * known.size_m[axis]);
      CHECK(std::abs(box.center()[axis]) <= 0.06 * known.size_m[axis]);
    }
  }
}

TEST_CASE("a boat's bow is sharp and its stern is square") {
  const auto mesh = surface_of(Solid{Figure{Figure::Kind::kBoat, {2.0, 6.0, 2.0}}}, 1e-3).mesh;
  double bow_m = 0.0, stern_m = 0.0;  // half widths
  for (const auto& vertex : mesh.vertex_m) {
    if (vertex.y() > 2.999F) bow_m = std::max(bow_m, std::abs(static_cast<double>(vertex.x())));
    if (vertex.y() < -2.999F) stern_m = std::max(stern_m, std::abs(static_cast<double>(vertex.x())));
  }
  CHECK(bow_m < 1e-6);
  CHECK(stern_m == Approx(1.0));
  // Box, cabin and two halves of a bow that are triangles from above.
  CHECK(volume_m3(mesh) == Approx(2.0 * 3.9 * 1.2 + 1.2 * 1.8 * 0.8 + 0.5 * 2.0 * 2.1 * 1.2));
}

TEST_CASE("figures without a size are refused") {
  CHECK_THROWS_WITH(surface_of(Solid{Figure{Figure::Kind::kTrap, {1, 0, 1}}}, 1e-3), "object: a size is not above 0 m");
}
