#include "components/terrain/prepared_mesh.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string_view>
#include <vector>

#include "components/config/config_error.h"
#include "components/terrain/source_of.h"
#include "components/terrain/tiles/file_bytes.h"

using namespace ensonify;
using namespace ensonify::source;
using Catch::WithinAbs;

namespace {

constexpr double kPi = 3.14159265358979;

/// A ridge of 3 x 3 vertices, or of more rows, as an OBJ that lives as long as the test.
struct Ridge {
  Ridge() {
    std::filesystem::create_directories(folder);
    write(0.5);
  }
  ~Ridge() { std::filesystem::remove_all(folder); }
  void write(double height, int rows = 3) const {
    std::ofstream file(path);
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < 3; ++i) file << "v " << 2 * i << " " << 2 * j << " " << (i == 1 ? height : 0.0) << "\n";
    }
    for (int v = 1; v < 3 * rows - 3; ++v) {
      if (v % 3 == 0) continue;
      file << "f " << v << " " << v + 1 << " " << v + 4 << "\n";
      file << "f " << v << " " << v + 4 << " " << v + 3 << "\n";
    }
  }
  std::filesystem::path folder = std::filesystem::temp_directory_path() / "ensonify_prepared_mesh";
  std::string path = folder / "ridge.obj";
};

frames::Vec3 vertex(const progressive::Hierarchy& hierarchy, std::size_t v) {
  return hierarchy.mesh.origin_enu_m + hierarchy.mesh.vertex_m[v].cast<double>();
}

/// Ground of 100 m square, 20 m deep at its middle, that falls to the east by a metre in ten. Class 3 east of 10 m.
std::unique_ptr<TerrainSource> slope() {
  TerrainOptions options;
  options.seabed.layered.size_m = {100.0, 100.0};
  const relief::Plane plane{.depth_m = 20.0, .slope = 0.1, .downhill_heading_rad = 0.5 * kPi};
  layers::Layer east{.name = "east", .form = layers::Paint{}, .sediment = 3};
  east.mask.emplace().polygon_enu_m = {{10, -50}, {50, -50}, {50, 50}, {10, 50}};
  options.seabed.layered.layers = {{.name = "ground", .form = plane}, east};
  return source_of(options);
}

/// A pole a metre high, standing on the ground.
SeabedMesh poles(int count, std::vector<std::uint8_t> on = {}) {
  SeabedMesh mesh{.name = "poles", .bars = {{.from_m = {0, 0, 0}, .to_m = {0, 0, 1}, .diameter_m = 0.2}}};
  mesh.strewn = {
      .count = count, .where = {.from_enu_m = {-50, 0}, .to_enu_m = {50, 0}, .width_m = 60}, .on = std::move(on)};
  mesh.strewn->place = {"s.yaml", 3, 9};
  return mesh;
}

}  // namespace

TEST_CASE("stored splits are used for the same file and unit only, else made anew") {
  const Ridge ridge;
  const std::string lod = lod_path_of(ridge.path);
  const PreparedMesh made = prepared_mesh(ridge.path, 1.0, lod);
  CHECK_FALSE(made.cached);
  CHECK_FALSE(std::filesystem::exists(lod));  // the caller's to write
  write_lod_file(lod, made.lod);
  CHECK(prepared_mesh(ridge.path, 1.0, lod).cached);
  CHECK_FALSE(prepared_mesh(ridge.path, 0.001, lod).cached);
  auto bytes = tiles::read_file(lod);
  bytes[200] ^= 1;
  tiles::write_file(lod, bytes);
  CHECK_FALSE(prepared_mesh(ridge.path, 1.0, lod).cached);
  tiles::write_file(lod, std::string_view("ensonify: lod/2\n"));
  CHECK_FALSE(prepared_mesh(ridge.path, 1.0, lod).cached);
  write_lod_file(lod, made.lod);
  ridge.write(0.75);
  const PreparedMesh anew = prepared_mesh(ridge.path, 1.0, lod);
  CHECK_FALSE(anew.cached);
  CHECK(vertex(anew.lod.hierarchy, 1).z() == 0.75);
}

TEST_CASE("a mesh of a file stands where the scenario says, turned clockwise, cached or not") {
  const Ridge ridge;
  const SeabedMesh mesh{.name = "ridge",
                        .file = ridge.path,
                        .unit_m = 10.0,
                        .position_enu_m = {100.0, 50.0, -9.0},
                        .heading_rad = 0.5 * 3.14159265358979};
  const PlacedMesh placed = placed_mesh(mesh, 1, *slope());
  // 20 m along the file's x and 40 m along its y: 40 m to the east and 20 m to the south.
  CHECK((vertex(placed.hierarchy, 7) - frames::Vec3(140.0, 30.0, -4.0)).norm() < 1e-4);
  write_lod_file(lod_path_of(ridge.path), prepared_mesh(ridge.path, 10.0, "").lod);
  const PlacedMesh again = placed_mesh(mesh, 1, *slope());
  CHECK(again.hierarchy.mesh.vertex_m == placed.hierarchy.mesh.vertex_m);
  CHECK(again.hierarchy.born == placed.hierarchy.born);
}

TEST_CASE("a mesh is tilted towards a heading, and a file's y axis may be up") {
  const Ridge ridge;
  SeabedMesh mesh{.name = "ridge", .file = ridge.path, .tilt_rad = 0.5 * kPi, .tilt_heading_rad = 0.5 * kPi};
  const auto corner = [&] { return vertex(placed_mesh(mesh, 1, *slope()).hierarchy, 7); };
  // 2 east, 4 north and 0.5 up in the file: fallen over to the east, what was up is east, what was east is down.
  CHECK((corner() - frames::Vec3(0.5, 4.0, -2.0)).norm() < 1e-5);
  mesh.tilt_rad = 0.0;
  mesh.up = SeabedMesh::Up::kY;
  CHECK((corner() - frames::Vec3(2.0, -0.5, 4.0)).norm() < 1e-5);
  mesh.heading_rad = 0.5 * kPi;
  CHECK((corner() - frames::Vec3(-0.5, -2.0, 4.0)).norm() < 1e-5);
}

TEST_CASE("only a file of more than 2000 vertices is worth preparing") {
  const Ridge ridge;
  SeabedMesh mesh{.name = "ridge", .file = ridge.path};
  const auto is_worth_it = [&] { return placed_mesh(mesh, 1, *slope()).worth_preparing; };
  CHECK_FALSE(is_worth_it());
  ridge.write(0.5, 700);
  CHECK(is_worth_it());
  write_lod_file(lod_path_of(ridge.path), prepared_mesh(ridge.path, 1.0, "").lod);
  CHECK_FALSE(is_worth_it());
}

TEST_CASE("a generated wall depends on the seed and on its name") {
  SeabedMesh mesh{.name = "quay", .wall = progressive::SheetPileWall{}};
  mesh.wall->to_enu_m = {12.0, 0.0};
  const auto at_seed = [&](std::uint64_t seed) { return placed_mesh(mesh, seed, *slope()).hierarchy.mesh.vertex_m; };
  const auto quay = at_seed(1);
  CHECK(at_seed(1) == quay);
  CHECK(at_seed(2) != quay);
  mesh.name = "pier";
  CHECK(at_seed(1) != quay);
}

TEST_CASE("bars stand where the scenario says, turned clockwise") {
  SeabedMesh mesh{.name = "beam", .position_enu_m = {100, 50, -9}, .heading_rad = 0.5 * kPi};
  mesh.bars = {{.from_m = {0, 0, 0}, .to_m = {0, 30, 0}, .section_m = {1, 2}}};
  const auto placed = placed_mesh(mesh, 1, *slope());
  CHECK_FALSE(placed.worth_preparing);
  Eigen::AlignedBox3d box;
  for (std::size_t v = 0; v < placed.hierarchy.mesh.vertex_m.size(); ++v) box.extend(vertex(placed.hierarchy, v));
  CHECK((box.min() - frames::Vec3(100, 49.5, -10)).norm() < 1e-4);
  CHECK((box.max() - frames::Vec3(130, 50.5, -8)).norm() < 1e-4);
}

TEST_CASE("strewn copies stand on the ground, on the set classes, by seed and name") {
  const auto ground = slope();
  const auto feet = [&](const SeabedMesh& mesh, std::uint64_t seed) {  // the middle of the lower end
    const auto hierarchy = placed_mesh(mesh, seed, *ground).hierarchy;
    std::vector<frames::Vec3> places;
    for (std::size_t v = 32; v < hierarchy.mesh.vertex_m.size(); v += 34) places.push_back(vertex(hierarchy, v));
    return places;
  };
  const auto all = feet(poles(40), 1), east = feet(poles(40, {3}), 1);
  REQUIRE(all.size() == 40);
  REQUIRE(east.size() == 40);
  for (const auto& foot : all) CHECK_THAT(foot.z(), WithinAbs(-20 - 0.1 * foot.x(), 3e-4));  // a step of heights
  for (const auto& foot : east) CHECK(foot.x() > 10 - 0.25);                                 // half a post
  CHECK(std::any_of(all.begin(), all.end(), [](const frames::Vec3& foot) { return foot.x() < 0; }));
  CHECK(feet(poles(40), 1) == all);
  CHECK(feet(poles(40), 2) != all);
  SeabedMesh other = poles(40);
  other.name = "posts";
  CHECK(feet(other, 1) != all);
  CHECK(std::equal(all.begin(), all.begin() + 10, feet(poles(10), 1).begin(),
                   [](const auto& a, const auto& b) { return (a - b).norm() < 1e-4; }));  // fewer: the first ones
}

TEST_CASE("copies without ground, or too many of them, are refused") {
  CHECK_THROWS_WITH(
      placed_mesh(poles(5, {7}), 1, *slope()),
      "s.yaml:3:9: seabed.meshes.poles.strewn: found ground for 0 of 5 copies; widen the rectangle, or `on`");
  CHECK_THROWS_WITH(placed_mesh(poles(100'000), 1, *slope()),
                    "s.yaml:3:9: seabed.meshes.poles.strewn: makes 3400000 vertices; allowed: 2000000");
}

TEST_CASE("a mesh beyond float precision is refused, with its file") {
  const Ridge ridge;
  ridge.write(1e39);
  CHECK_THROWS_WITH(prepared_mesh(ridge.path, 1.0, ""),
                    Catch::Contains("ridge.obj") && Catch::Contains("is not finite"));
}
