#include <catch2/catch.hpp>
#include <filesystem>

#include "components/terrain/prepared_mesh.h"
#include "components/terrain/tiles/file_bytes.h"
#include "kernels/mesh/progressive/cut.h"

using namespace ensonify;
using namespace ensonify::source;
using Catch::Matchers::Contains;

namespace {

/// A roof of 12 x 12 vertices.
LodFile roof() {
  progressive::TriangleMesh mesh;
  mesh.origin_enu_m = {485355.0, 58819.0, -3.0};
  for (int j = 0; j < 12; ++j) {
    for (int i = 0; i < 12; ++i)
      mesh.vertex_m.emplace_back(0.5F * float(i), 0.5F * float(j), 0.1F * float((i * j) % 7));
  }
  for (std::uint32_t j = 0; j < 11; ++j) {
    for (std::uint32_t i = 0; i < 11; ++i) {
      const std::uint32_t v = 12 * j + i;
      mesh.triangle.push_back({v, v + 1, v + 13});
      mesh.triangle.push_back({v, v + 13, v + 12});
    }
  }
  const auto collapses = progressive::collapses_of(mesh);
  return {progressive::hierarchy_of(mesh, collapses), std::string(64, 'a'), 0.001};
}

}  // namespace

TEST_CASE("a mesh with its splits comes back from a file, and no damage passes") {
  const std::string path = std::filesystem::temp_directory_path() / "ensonify_roof.lod";
  const LodFile written = roof();
  write_lod_file(path, written);
  const LodFile read = read_lod_file(path);
  CHECK(read.source_sha256 == written.source_sha256);
  CHECK(read.unit_m == 0.001);
  const auto &a = read.hierarchy, &b = written.hierarchy;
  CHECK(a.mesh.origin_enu_m == b.mesh.origin_enu_m);
  CHECK(a.mesh.vertex_m == b.mesh.vertex_m);
  CHECK(a.mesh.triangle == b.mesh.triangle);
  CHECK(a.born == b.born);
  CHECK(a.coarsest == b.coarsest);
  CHECK(a.split_of == b.split_of);
  REQUIRE(a.splits.size() == b.splits.size());
  progressive::View view{.frustum = {.apex_enu_m = b.mesh.origin_enu_m + frames::Vec3(3, 3, 5), .max_range_m = 20.0}};
  view.frustum.low_sine = -0.05, view.frustum.high_sine = 0.05;
  view.frustum.low_angle_rad = -4.0, view.frustum.high_angle_rad = 4.0;
  const std::vector<progressive::View> views = {view};
  progressive::Cut of_read(a), of_written(b);
  of_read.choose(a, views);
  of_written.choose(b, views);
  CHECK(of_read.triangles().size() > 20);
  CHECK(std::equal(of_read.triangles().begin(), of_read.triangles().end(), of_written.triangles().begin(),
                   of_written.triangles().end()));

  const auto bytes = tiles::read_file(path);
  for (std::size_t byte = 16; byte < bytes.size(); byte += 97) {
    auto flipped = bytes;
    flipped[byte] ^= 0x10;
    tiles::write_file(path, flipped);
    CHECK_THROWS_WITH(read_lod_file(path), Contains("is damaged"));
  }
  tiles::write_file(path, std::span(bytes).first(bytes.size() / 2));
  CHECK_THROWS_WITH(read_lod_file(path), Contains("is damaged"));
  tiles::write_file(path, std::string_view("ensonify: lod/2\n"));
  CHECK_THROWS_WITH(read_lod_file(path), Contains("is no mesh with level of detail of this version"));
  std::filesystem::remove(path);
}
