#include "components/terrain/object_meshes.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "components/config/config_error.h"
#include "components/terrain/mesh_import.h"

using namespace ensonify;
using namespace ensonify::source;
namespace fs = std::filesystem;

namespace {

class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("object_meshes_test_" + std::to_string(getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  fs::path path_;
};

SceneObject object_of(const std::string& path, std::optional<double> unit_m = {}, bool y_is_up = false) {
  SceneObject object;
  object.name = "thing";
  object.solid = solids::Mesh{};
  object.file = ObjectFile{path, unit_m, y_is_up};
  return object;
}

/// A cuboid of 1 x 2 x 3 in the file's unit, its corner at the origin: facets of an STL file as text.
std::string stl(double unit = 1.0, bool inside_out = false, int facets = 12) {
  const int faces[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                            {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  std::string text = "solid box\n";
  for (int f = 0; f < facets; ++f) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (int c = 0; c < 3; ++c) {
      const int v = faces[f][inside_out ? 2 - c : c];
      text += "vertex " + std::to_string(unit * (v & 1)) + " " + std::to_string(unit * 2 * (v >> 1 & 1)) + " " +
              std::to_string(unit * 3 * (v >> 2)) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid box\n";
}

const std::string kOff =
    "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";  // a tetrahedron

std::string fault(const SceneObject& object) {
  ObjectMeshes meshes;
  try {
    meshes.of(object);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a cuboid in STL is read, joined, closed, and stands about its middle") {
  const Folder folder;
  ObjectMeshes meshes;
  const ObjectMeshFile& read = meshes.of(object_of(folder.write("box.stl", stl())));
  const auto& triangles = *read.mesh.triangles;
  CHECK(triangles.vertex_m.size() == 8);
  CHECK(triangles.triangle.size() == 12);
  CHECK(read.mesh.closed);
  CHECK(read.said.empty());
  CHECK(solids::volume_below_m3(triangles, 10.0) == Approx(6.0));
  CHECK(triangles.vertex_m[0].cwiseAbs() == Eigen::Vector3f(0.5F, 1.0F, 1.5F));
}

TEST_CASE("OFF and glTF are read; a glTF's y is up") {
  const Folder folder;
  ObjectMeshes meshes;
  CHECK(solids::volume_below_m3(*meshes.of(object_of(folder.write("t.off", kOff))).mesh.triangles, 10.0) ==
        Approx(1.0 / 6.0));
  // One triangle in the plane z = 0 of the file, its buffer within the file: (0 0 0), (1 0 0), (0 2 0).
  const std::string gltf =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
      R"("buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAA"}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":36}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,2,0]}]})";
  const ObjectMeshFile& read = meshes.of(object_of(folder.write("t.gltf", gltf), {}, true));
  CHECK(read.number == 1);
  CHECK_FALSE(read.mesh.closed);
  CHECK(read.said == "not closed: both sides of its surface scatter");
  Eigen::AlignedBox3f box;
  for (const auto& vertex : read.mesh.triangles->vertex_m) box.extend(vertex);
  CHECK(box.sizes() == Eigen::Vector3f(1, 0, 2));  // its height is up
}

TEST_CASE("a file is read once; its unit is given, or guessed and said") {
  const Folder folder;
  ObjectMeshes meshes;
  const std::string path = folder.write("mm.stl", stl(1000.0));
  const ObjectMeshFile& read = meshes.of(object_of(path));
  CHECK(solids::volume_below_m3(*read.mesh.triangles, 10.0) == Approx(6.0));
  CHECK(read.said == "in millimetres, as it would be larger than 100 m; unit_m says otherwise");
  CHECK(&meshes.of(object_of(path)) == &read);
  const ObjectMeshFile& metres = meshes.of(object_of(path, 1.0));
  CHECK(metres.number == 1);
  CHECK(metres.said.empty());
  CHECK(solids::volume_below_m3(*metres.mesh.triangles, 1e4) == Approx(6e9));
}

TEST_CASE("what is inside out is turned, and what is open has two sides") {
  const Folder folder;
  ObjectMeshes meshes;
  const ObjectMeshFile& turned = meshes.of(object_of(folder.write("in.stl", stl(1.0, true))));
  CHECK(turned.said == "inside out: turned");
  CHECK(solids::volume_below_m3(*turned.mesh.triangles, 10.0) == Approx(6.0));
  const ObjectMeshFile& open = meshes.of(object_of(folder.write("open.stl", stl(1.0, false, 11))));
  CHECK_FALSE(open.mesh.closed);
  CHECK(open.said == "not closed: both sides of its surface scatter");
}

TEST_CASE("meshes that cannot be used are refused with what is wrong") {
  const Folder folder;
  const auto says = [&](const std::string& name, const std::string& text, const std::string& what) {
    CAPTURE(name);
    CHECK_THAT(fault(object_of(folder.write(name, text))), Catch::Contains(name) && Catch::Contains(what));
  };
  says("empty.stl", "", "cannot be read");
  says("none.off", "OFF\n0 0 0\n", "");
  says("noise.glb", std::string(200, '\x7f'), "cannot be read");
  says(
      "lost.gltf",
      R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
      R"("buffers":[{"byteLength":36,"uri":"gone.bin"}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}]})",
      "cannot be read");
  says("flat.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n", "has no area");
  says("nan.stl",
       "solid x\nfacet normal 0 0 0\nouter loop\nvertex 0 0 nan\nvertex 1 0 0\nvertex 0 1 "
       "0\nendloop\nendfacet\nendsolid x\n",
       "");
  CHECK_THAT(fault(object_of("/nowhere/at.stl")), Catch::Contains("cannot be read"));
}
