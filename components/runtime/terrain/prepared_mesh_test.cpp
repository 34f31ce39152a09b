#include "components/runtime/terrain/prepared_mesh.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "components/runtime/config/config_error.h"
#include "components/runtime/tiles/file_bytes.h"

using namespace ensonify;
using namespace ensonify::source;

namespace {

/// A ridge of 3 x 3 vertices as an OBJ that lives as long as the test.
struct Ridge {
  Ridge() {
    std::filesystem::create_directories(folder);
    write(0.5);
  }
  ~Ridge() { std::filesystem::remove_all(folder); }
  void write(double height) const {
    std::ofstream file(path);
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) file << "v " << 2 * i << " " << 2 * j << " " << (i == 1 ? height : 0.0) << "\n";
    }
    for (const int v : {1, 2, 4, 5}) {
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

}  // namespace

TEST_CASE("splits are read when they were made of this file in this unit, and made anew otherwise") {
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
  const PlacedMesh placed = placed_mesh(mesh, 1);
  CHECK_FALSE(placed.cached);
  // 20 m along the file's x and 40 m along its y: 40 m to the east and 20 m to the south.
  CHECK((vertex(placed.hierarchy, 7) - frames::Vec3(140.0, 30.0, -4.0)).norm() < 1e-4);
  write_lod_file(lod_path_of(ridge.path), prepared_mesh(ridge.path, 10.0, "").lod);
  const PlacedMesh again = placed_mesh(mesh, 1);
  CHECK(again.cached);
  CHECK(again.hierarchy.mesh.vertex_m == placed.hierarchy.mesh.vertex_m);
  CHECK(again.hierarchy.born == placed.hierarchy.born);
}

TEST_CASE("a generated wall depends on the seed and on its name") {
  SeabedMesh mesh{.name = "quay", .wall = progressive::SheetPileWall{}};
  mesh.wall->to_enu_m = {12.0, 0.0};
  const auto at_seed = [&](std::uint64_t seed) { return placed_mesh(mesh, seed).hierarchy.mesh.vertex_m; };
  const auto quay = at_seed(1);
  CHECK(at_seed(1) == quay);
  CHECK(at_seed(2) != quay);
  mesh.name = "pier";
  CHECK(at_seed(1) != quay);
}

TEST_CASE("a mesh beyond what floats tell is refused, with its file") {
  const Ridge ridge;
  ridge.write(1e39);
  CHECK_THROWS_WITH(prepared_mesh(ridge.path, 1.0, ""),
                    Catch::Contains("ridge.obj") && Catch::Contains("is not finite"));
}
