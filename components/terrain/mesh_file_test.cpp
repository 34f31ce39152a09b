#include "components/terrain/mesh_file.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "components/config/config_error.h"

using namespace ensonify;
using namespace ensonify::source;

namespace {

/// A file of these bytes, gone at the end of the test.
class Written {
 public:
  Written(const std::string& name, const std::string& bytes)
      : path_(std::filesystem::temp_directory_path() / ("ensonify_mesh_" + name)) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~Written() { std::filesystem::remove(path_); }
  Written(const Written&) = delete;
  Written& operator=(const Written&) = delete;
  std::string path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string fault(const std::string& name, const std::string& bytes) {
  const Written file(name, bytes);
  try {
    read_mesh_file(file.path());
  } catch (const ConfigError& error) {
    const std::string text = error.what();
    return text.substr(text.find(name) + name.size());
  }
  return "";
}

template <class Number>
void put(std::string& bytes, Number number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

}  // namespace

TEST_CASE("an OBJ's faces, with normals and textures, counted from the end, of four corners") {
  const Written file("roof.obj",
                     "# roof\nmtllib none.mtl\nv 0 0 -5\nv 1 0 -5 0.5 0.5 0.5\nvn 0 0 1\nv 1 1 -4\nv 0 1 -4.25\n"
                     "f 1/1/1 2//1 3 4\nf -4 -3 -1\nf 1 1 2\n");
  const MeshFile mesh = read_mesh_file(file.path());
  REQUIRE(mesh.vertex.size() == 4);
  CHECK(mesh.vertex[3] == frames::Vec3(0, 1, -4.25));
  const std::vector<std::array<std::uint32_t, 3>> faces = {{0, 1, 2}, {0, 2, 3}, {0, 1, 3}};
  CHECK(mesh.triangle == faces);
}

TEST_CASE("a PLY in text and in bytes is the same mesh") {
  const std::string rest =
      "element vertex 3\nproperty double x\nproperty double y\nproperty float z\nproperty uchar red\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment made\n" + rest;
  const double places[3][2] = {{485355.25, 58819.5}, {485360.25, 58819.5}, {485355.25, 58824.5}};
  for (const auto& [x, y] : places) {
    put(bytes, x), put(bytes, y), put(bytes, -1.5F);
    put(bytes, std::uint8_t{200});
  }
  put(bytes, std::uint8_t{3});
  for (const std::int32_t corner : {0, 1, 2}) put(bytes, corner);
  const Written binary("b.ply", bytes);
  const Written text("a.ply", "ply\nformat ascii 1.0\n" + rest +
                                  "485355.25 58819.5 -1.5 200\n485360.25 58819.5 -1.5 200\n485355.25 58824.5 -1.5 200\n"
                                  "3 0 1 2\n");
  const MeshFile one = read_mesh_file(binary.path()), other = read_mesh_file(text.path());
  CHECK(one.vertex == other.vertex);
  CHECK(one.triangle == other.triangle);
  CHECK(one.vertex[1] == frames::Vec3(485360.25, 58819.5, -1.5));
  CHECK(one.triangle.size() == 1);
}

TEST_CASE("what is no mesh is refused with place and cause") {
  CHECK(fault("a.obj", "v 0 0\n") == ":1:1: is no vertex; allowed: v and three numbers");
  CHECK(fault("b.obj", "v 0 0 0\nf 1 2 3\n") ==
        ":2:1: \"2\" is no vertex; allowed: a number of one of the lines v above it");
  CHECK(fault("c.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n") == ":3:1: is no face; allowed: f and three vertices or more");
  CHECK(fault("d.obj", "v 0 0 0\n") == ":1:1: holds no triangle; allowed are meshes in OBJ, PLY, STL, OFF or glTF");
  CHECK(fault("e.ply", "ply\nformat binary_big_endian 1.0\n") ==
        ":2:1: format binary_big_endian is not read; allowed: ascii, binary_little_endian");
  CHECK(fault("f.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nend_header\n1\n") ==
        ":1:1: ends within its 2 elements vertex");
  CHECK(fault("g.ply",
              "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
              "element face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n3 0 0 7\n") ==
        ":1:1: has a face with a corner 7, of 1 vertices");
  CHECK(fault("h.ply", "ply\nformat ascii 1.0\n") == ":1:1: has no end_header");
  CHECK_THROWS_AS(read_mesh_file("no/such.obj"), ConfigError);
  CHECK(fault("i.obj", "v 0 0 0\nv 1 1 1\nv 0.1 0.1 0.1\nv 1 1 1\nf 1 2 3\nf 1 2 4\n") ==
        ":1:1: has no area: the corners of each of its triangles lie on one line");
}
