#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "messages/array.h"

namespace ensonify::msg {

struct Tile {
  static constexpr const char* kType = "tile/1";
  static constexpr const char* kAbout = "A square piece of seabed. Truth.";
  std::int64_t col = 0;
  std::int64_t row = 0;
  double origin_east_m = 0.0;
  double origin_north_m = 0.0;
  double spacing_m = 1.0;
  Array<float> height_m;
  Array<std::uint8_t> sediment;
  Array<double> facet_mean_square_slope;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("col", "1", "tile index, east", self.col);
    visit("row", "1", "tile index, north", self.row);
    visit("origin_east_m", "m", "world east of the south-west post (false origin)", self.origin_east_m);
    visit("origin_north_m", "m", "world north of the south-west post (false origin)", self.origin_north_m);
    visit("spacing_m", "m", "distance between posts, both axes", self.spacing_m);
    visit("height_m", "m", "posts (north x east, south-west first), up from chart datum; NaN is a hole", self.height_m);
    visit("sediment", "1", "sediment class of each post, as height_m", self.sediment);
    visit("facet_mean_square_slope", "1",
          "mean square slope, by class of all the seabed, that facets have of relief which the sediment's law counts "
          "too and must not count again; 0 or not listed: none that is known",
          self.facet_mean_square_slope);
  }
};

struct TileRelease {
  static constexpr const char* kType = "tile_release/1";
  static constexpr const char* kAbout = "The pager will not refer to this tile again until it sends it anew.";
  std::int64_t col = 0;
  std::int64_t row = 0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("col", "1", "tile index, east", self.col);
    visit("row", "1", "tile index, north", self.row);
  }
};

struct Mesh {
  static constexpr const char* kType = "mesh/1";
  static constexpr const char* kAbout =
      "A surface of triangles that stands in the seabed: a quay wall, a scanned object. Truth. Who wants all of it "
      "needs "
      "the vertices and triangles alone; the splits say how to coarsen it (docs/physics/mesh/irregular-meshes.md).";
  std::int64_t number = 0;
  std::string name;
  std::int64_t sediment = 0;
  std::array<double, 3> origin_enu_m{};
  Array<float> vertex_m;
  Array<std::uint32_t> triangle;
  Array<std::int32_t> split;
  Array<float> split_deviation_m;
  Array<float> split_box_m;
  Array<std::uint32_t> born;
  Array<std::uint32_t> coarsest;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("number", "1", "number by which the object is released", self.number);
    visit("name", "", "name in the scenario", self.name);
    visit("sediment", "1", "sediment class of all of it", self.sediment);
    visit("origin_enu_m", "m", "origin that the vertices count from", self.origin_enu_m);
    visit("vertex_m", "m", "east, north, up of each vertex", self.vertex_m);
    visit("triangle", "1", "three vertices each", self.triangle);
    visit("split", "1",
          "coarsest first: the vertex that it brings back, the one that it comes out of, parent and two children (-1: "
          "none), first and number of the triangles that come with it, in `born`",
          self.split);
    visit("split_deviation_m", "m", "estimate of the surface's deviation without this split and those below it",
          self.split_deviation_m);
    visit("split_box_m", "m", "least and greatest east, north, up, as vertices, of all triangles that change below it",
          self.split_box_m);
    visit("born", "1", "triangles by the split that brings them", self.born);
    visit("coarsest", "1", "triangles that are there without any split", self.coarsest);
  }
};

struct MeshRelease {
  static constexpr const char* kType = "mesh_release/1";
  static constexpr const char* kAbout = "The pager will not refer to this mesh again until it sends it anew.";
  std::int64_t number = 0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("number", "1", "the mesh's", self.number);
  }
};

struct Object {
  static constexpr const char* kType = "object/1";
  static constexpr const char* kAbout = "A thing on the seabed or in the water that labels know. Truth.";
  std::int64_t number = 0;
  std::string name;
  std::int64_t instance = 0;
  std::string class_name;
  std::int64_t class_id = 0;
  std::string shape;
  std::array<double, 3> size_m{};
  std::int64_t mesh = -1;
  std::array<double, 3> position_enu_m{};
  std::array<double, 4> enu_from_object{1.0, 0.0, 0.0, 0.0};
  bool smooth = false;
  std::int64_t sediment = 0;
  double buried = 0.0;
  bool absent = false;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("number", "1", "number by which the object is released", self.number);
    visit("name", "", "name in the scenario", self.name);
    visit("instance", "1", "number in labels, from 1", self.instance);
    visit("class_name", "", "class in labels", self.class_name);
    visit("class_id", "1", "number of the class in labels, from 1", self.class_id);
    visit("shape", "", "word of its shape, as objects of a scenario have it", self.shape);
    visit("size_m", "m", "sizes of its shape, in the order of the scenario's keys, then 0; of a mesh its scale",
          self.size_m);
    visit("mesh", "1", "number of the object_mesh/1 that is its shape; -1: its shape follows from its sizes",
          self.mesh);
    visit("position_enu_m", "m", "world position of its middle", self.position_enu_m);
    visit("enu_from_object", "1", "rotation [w, x, y, z] from its own axes (x east, y north, z up when not turned)",
          self.enu_from_object);
    visit("smooth", "", "smoothness: its echo follows from its shape; false: it scatters as its sediment, with speckle",
          self.smooth);
    visit("sediment", "1", "sediment class of all of it", self.sediment);
    visit("buried", "1", "part of the volume, 0..1, below the height of the seabed at its middle", self.buried);
    visit("absent", "", "absence: nothing hits it, and its box counts as if it stood there", self.absent);
  }
};

struct ObjectMesh {
  static constexpr const char* kType = "object_mesh/1";
  static constexpr const char* kAbout = "The shape of objects that have it in common, from a file. Truth.";
  std::int64_t number = 0;
  bool closed = false;
  Array<float> vertex_m;
  Array<std::uint32_t> triangle;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("number", "1", "number by which objects name it", self.number);
    visit("closed", "1", "closedness: it has an inside, and only its outside scatters", self.closed);
    visit("vertex_m", "m", "vertices (vertex x 3) about its middle: x east, y north, z up when not turned",
          self.vertex_m);
    visit("triangle", "1", "corners (triangle x 3), counterclockwise as seen from outside", self.triangle);
  }
};

struct ObjectRelease {
  static constexpr const char* kType = "object_release/1";
  static constexpr const char* kAbout = "The pager will not refer to this object again until it sends it anew.";
  std::int64_t number = 0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("number", "1", "the object's", self.number);
  }
};

struct Chart {
  static constexpr const char* kType = "chart/1";
  static constexpr const char* kAbout =
      "What is known of the terrain as a whole, as on a chart: mission planning may use it.";
  double origin_latitude_deg = 0.0;
  double origin_longitude_deg = 0.0;
  double west_m = 0.0;
  double south_m = 0.0;
  double east_m = 0.0;
  double north_m = 0.0;
  double shallowest_m = 0.0;
  double deepest_m = 0.0;
  double spacing_m = 1.0;
  Array<float> height_m;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("origin_latitude_deg", "deg",
          "geodetic latitude of the world's origin, WGS 84 (a scenario may leave it to the raster)",
          self.origin_latitude_deg);
    visit("origin_longitude_deg", "deg", "longitude of the world's origin, WGS 84", self.origin_longitude_deg);
    visit("west_m", "m", "world east of the western edge", self.west_m);
    visit("south_m", "m", "world north of the southern edge", self.south_m);
    visit("east_m", "m", "world east of the eastern edge", self.east_m);
    visit("north_m", "m", "world north of the northern edge", self.north_m);
    visit("shallowest_m", "m", "least depth below chart datum, positive down", self.shallowest_m);
    visit("deepest_m", "m", "greatest depth below chart datum, positive down", self.deepest_m);
    visit("spacing_m", "m", "distance between the posts of height_m", self.spacing_m);
    visit("height_m", "m", "coarse heights (north x east, south-west first), up; NaN where nothing is known",
          self.height_m);
  }
};

}  // namespace ensonify::msg
